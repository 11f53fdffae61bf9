# SPDX-License-Identifier: MIT
# Compiles every shaders/<operation>/<kernel>.comp to SPIR-V, simplifies and checks it (cmake/kernel_compiler), and embeds
# it as the kernel "<operation>/<kernel>". Kernels that include lib/bound.glsl are compiled twice. Kernels of a folder are
# compiled together.

if(CMAKE_CROSSCOMPILING)
    include(ExternalProject)
    ExternalProject_Add(zvo_kernel_compiler_build
        SOURCE_DIR ${CMAKE_CURRENT_LIST_DIR}/kernel_compiler
        # Without what an environment says of compilers for the other machine.
        CONFIGURE_COMMAND ${CMAKE_COMMAND} -E env --unset=CC --unset=CXX --unset=CXXFLAGS --unset=LDFLAGS
            --unset=CMAKE_TOOLCHAIN_FILE ${CMAKE_COMMAND} -G ${CMAKE_GENERATOR} -S <SOURCE_DIR> -B <BINARY_DIR>
            -DCMAKE_BUILD_TYPE=Release
        BUILD_COMMAND ${CMAKE_COMMAND} --build <BINARY_DIR>
        BUILD_ALWAYS TRUE
        BUILD_BYPRODUCTS <BINARY_DIR>/zvo_kernel_compiler
        INSTALL_COMMAND ""
        EXCLUDE_FROM_ALL TRUE)
    ExternalProject_Get_Property(zvo_kernel_compiler_build BINARY_DIR)
    add_executable(zvo_kernel_compiler IMPORTED GLOBAL)
    set_target_properties(zvo_kernel_compiler PROPERTIES IMPORTED_LOCATION ${BINARY_DIR}/zvo_kernel_compiler)
    add_dependencies(zvo_kernel_compiler zvo_kernel_compiler_build)
else()
    add_subdirectory(${CMAKE_CURRENT_LIST_DIR}/kernel_compiler ${PROJECT_BINARY_DIR}/kernel_compiler)
endif()

# What the compilers of drivers would do first, and for every pipeline anew: functions are inlined, and what nobody uses
# goes. None of these passes changes arithmetic, so results stay the same bits.
set(ZVO_SPIRV_PASSES --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions
                     --eliminate-dead-code-aggressive)
# The kernels of voxelize/ are the longest: there, variables that are stored once become values as well. Elsewhere that
# changes which floating-point operations drivers fuse, and with them colours by 1/255.
set(ZVO_SPIRV_PASSES_VOXELIZE ${ZVO_SPIRV_PASSES} --eliminate-local-single-block --eliminate-local-single-store
                              --eliminate-dead-code-aggressive)

# zvo_choose_files(LIST ONLY WITHOUT): sorts a list of relative paths, and keeps those in the folder ONLY, or those
# outside of the folder WITHOUT.
function(zvo_choose_files list_name only without)
    set(paths ${${list_name}})
    list(SORT paths)
    if(only)
        list(FILTER paths INCLUDE REGEX "^${only}/")
    endif()
    if(without)
        list(FILTER paths EXCLUDE REGEX "^${without}/")
    endif()
    set(${list_name} ${paths} PARENT_SCOPE)
endfunction()

# zvo_compile_kernels(NAME LIST INCLUDE PASSES DEPENDS): makes the modules of a list, of which three elements stand for a
# kernel: its source, the module, and a word to define or `-`. One process compiles all of them.
function(zvo_compile_kernels name list include passes depends)
    set(lines "")
    set(sources "")
    set(modules "")
    while(list)
        list(POP_FRONT list source module word)
        string(REGEX REPLACE "^-$" "" word "${word}")
        string(APPEND lines "${source}\n${module}\n${word}\n")
        list(APPEND sources ${source})
        list(APPEND modules ${module})
        get_filename_component(folder ${module} DIRECTORY)
        file(MAKE_DIRECTORY ${folder})
    endwhile()
    set(list_file ${CMAKE_CURRENT_BINARY_DIR}/kernels/${name}.list)
    file(CONFIGURE OUTPUT ${list_file} CONTENT "${lines}" @ONLY)
    add_custom_command(
        OUTPUT ${modules}
        DEPFILE ${CMAKE_CURRENT_BINARY_DIR}/kernels/${name}.d
        COMMAND zvo_kernel_compiler ${list_file} ${include} ${CMAKE_CURRENT_BINARY_DIR}/kernels/${name}.d ${passes}
        DEPENDS zvo_kernel_compiler ${list_file} ${sources} ${depends}
        COMMENT "kernels ${name}"
        VERBATIM)
endfunction()

# zvo_place_symbol(TEXT NAME): appends to the assembler's text that NAME, which other files of the library see, is here.
function(zvo_place_symbol text_name name)
    if(APPLE)
        set(lines ".globl _${name}\n.private_extern _${name}\n_${name}:\n")
    else()
        set(lines ".globl ${name}\n.hidden ${name}\n${name}:\n")
    endif()
    set(${text_name} "${${text_name}}${lines}" PARENT_SCOPE)
endfunction()

# zvo_embed_kernels(TARGET ROOT FUNCTION [ONLY folder | WITHOUT folder] [INCLUDE dir] [DEPENDS target] [AS_COMPILED]):
# adds generated sources to TARGET that define `std::span<const zvo::vk::EmbeddedKernel> zvo::FUNCTION()`, all kernels
# below ROOT, those in a folder of it, or those in the others. They include what is below dir, by default zvo's own
# shaders, after target was made. AS_COMPILED: they are not simplified. The assembler copies the modules' bytes, which
# takes no time; a compiler would read them as numbers.
function(zvo_embed_kernels target root function_name)
    cmake_parse_arguments(arg "AS_COMPILED" "ONLY;WITHOUT;INCLUDE;DEPENDS" "" ${ARGN})
    if(NOT arg_INCLUDE)
        set(arg_INCLUDE ${PROJECT_SOURCE_DIR}/shaders)
    endif()
    set(passes ${ZVO_SPIRV_PASSES})
    if(arg_AS_COMPILED)
        set(passes "")
    endif()
    file(GLOB_RECURSE kernels CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*.comp)
    zvo_choose_files(kernels "${arg_ONLY}" "${arg_WITHOUT}")
    set(out_dir ${CMAKE_CURRENT_BINARY_DIR}/kernels/${target})
    set(section ".section .note.GNU-stack,\"\",%progbits\n.section .rodata")
    if(APPLE)
        set(section ".section __DATA,__const")
    endif()
    set(modules "")
    set(symbols "")
    set(declarations "")
    set(entries "")
    set(folders "")
    foreach(kernel ${kernels})
        string(REGEX REPLACE "\\.comp$" "" name ${kernel})
        get_filename_component(folder ${target}/${kernel} DIRECTORY)
        list(APPEND folders ${folder})
        set(forms ${name})
        file(STRINGS ${root}/${kernel} has_bound_form REGEX "^#include \"lib/bound.glsl\"$")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${root}/${kernel})
        if(has_bound_form)
            list(APPEND forms ${name}.bound)
        endif()
        set(words "")
        foreach(form ${forms})
            set(module ${out_dir}/${form}.spv)
            set(word -)
            if(form MATCHES "\\.bound$")
                set(word BOUND)
            endif()
            list(APPEND list_${folder} ${root}/${kernel} ${module} ${word})
            list(APPEND modules ${module})
            string(MAKE_C_IDENTIFIER ${target}_${form} symbol)
            string(APPEND symbols ".balign 4\n")
            zvo_place_symbol(symbols ${symbol})
            string(APPEND symbols ".incbin \"${module}\"\n")
            zvo_place_symbol(symbols ${symbol}_end)
            string(APPEND declarations "extern \"C\" const std::uint32_t ${symbol}[], ${symbol}_end[];\n")
            string(APPEND words ", {${symbol}, ${symbol}_end}")
        endforeach()
        string(APPEND entries "        {\"${name}\"${words}},\n")
    endforeach()
    list(REMOVE_DUPLICATES folders)
    foreach(folder ${folders})
        set(folder_passes ${passes})
        if(passes AND folder STREQUAL "${target}/voxelize")
            set(folder_passes ${ZVO_SPIRV_PASSES_VOXELIZE})
        endif()
        zvo_compile_kernels(${folder} "${list_${folder}}" ${arg_INCLUDE} "${folder_passes}" "${arg_DEPENDS}")
    endforeach()
    file(CONFIGURE OUTPUT ${out_dir}/modules.S @ONLY CONTENT
"/* Generated by cmake/Shaders.cmake. */
@section@
@symbols@")
    set_source_files_properties(${out_dir}/modules.S PROPERTIES OBJECT_DEPENDS "${modules}")
    file(CONFIGURE OUTPUT ${out_dir}/registry.cpp @ONLY CONTENT
"// Generated by cmake/Shaders.cmake.
#include \"vk/kernel.h\"

@declarations@
namespace zvo
{

std::span<const vk::EmbeddedKernel> @function_name@();
std::span<const vk::EmbeddedKernel> @function_name@()
{
    static const vk::EmbeddedKernel kernels[] = {
@entries@    };
    return kernels;
}

} // namespace zvo
")
    target_sources(${target} PRIVATE ${modules} ${out_dir}/modules.S ${out_dir}/registry.cpp)
endfunction()
