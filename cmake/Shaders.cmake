# SPDX-License-Identifier: MIT
# Compiles every shaders/<operation>/<kernel>.comp to SPIR-V, simplifies it, checks it with spirv-val and embeds it as
# the kernel "<operation>/<kernel>". Kernels that include lib/bound.glsl are compiled twice.

find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# At every start glslang makes tables of built-in functions, which is most of its time. It takes half as long where glibc
# gets memory in large pages.
set(ZVO_FAST_START GLIBC_TUNABLES=glibc.malloc.hugetlb=1:glibc.malloc.top_pad=268435456)

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

# zvo_compile_kernel(SOURCE OUTPUT INCLUDE DEFINES PASSES DEPENDS): makes OUTPUT, a checked SPIR-V module.
function(zvo_compile_kernel source output include defines passes depends)
    get_filename_component(folder ${output} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    file(RELATIVE_PATH name ${CMAKE_CURRENT_BINARY_DIR}/kernels ${output})
    add_custom_command(
        OUTPUT ${output}
        DEPFILE ${output}.d
        COMMAND ${CMAKE_COMMAND} -E env ${ZVO_FAST_START} ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.3 -I${include} ${defines} -S comp
                --depfile ${output}.d -o ${output} ${source}
        COMMAND ${SPIRV_OPT} --target-env=vulkan1.3 --scalar-block-layout --preserve-spec-constants
                ${passes} ${output} -o ${output}
        COMMAND ${SPIRV_VAL} --target-env vulkan1.3 --scalar-block-layout ${output}
        DEPENDS ${source} ${depends}
        COMMENT "kernel ${name}"
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
    foreach(kernel ${kernels})
        string(REGEX REPLACE "\\.comp$" "" name ${kernel})
        set(kernel_passes ${passes})
        if(passes AND name MATCHES "^voxelize/")
            set(kernel_passes ${ZVO_SPIRV_PASSES_VOXELIZE})
        endif()
        set(forms ${name})
        file(STRINGS ${root}/${kernel} has_bound_form REGEX "^#include \"lib/bound.glsl\"$")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${root}/${kernel})
        if(has_bound_form)
            list(APPEND forms ${name}.bound)
        endif()
        set(words "")
        foreach(form ${forms})
            set(module ${out_dir}/${form}.spv)
            set(defines "")
            if(form MATCHES "\\.bound$")
                set(defines -DBOUND)
            endif()
            zvo_compile_kernel(${root}/${kernel} ${module} ${arg_INCLUDE} "${defines}" "${kernel_passes}" "${arg_DEPENDS}")
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

# zvo_list_kernels(TARGET ROOT FUNCTION [ONLY folder | WITHOUT folder]): adds a generated source to TARGET that defines
# `std::vector<zvo::vk::KernelDeclaration> zvo::FUNCTION()`, what all headers below ROOT declare of kernels, those in a
# folder of it, or those in the others.
function(zvo_list_kernels target root function_name)
    cmake_parse_arguments(arg "" "ONLY;WITHOUT" "" ${ARGN})
    file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*.h)
    zvo_choose_files(headers "${arg_ONLY}" "${arg_WITHOUT}")
    list(TRANSFORM headers PREPEND ${root}/)
    list(JOIN headers "," joined)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/kernels/${target}_declarations.cpp)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DHEADERS=${joined} -DFUNCTION=${function_name} -DOUTPUT=${output}
                -P ${PROJECT_SOURCE_DIR}/cmake/ListKernels.cmake
        DEPENDS ${headers} ${PROJECT_SOURCE_DIR}/cmake/ListKernels.cmake
        COMMENT "kernels that headers declare"
        VERBATIM)
    target_sources(${target} PRIVATE ${output})
endfunction()
