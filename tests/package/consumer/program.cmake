# SPDX-License-Identifier: MIT
# The program, the same however zvo was found. A shader that includes zvo/trace.glsl is made beside it, and the example
# that makes a picture.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
add_custom_command(
    OUTPUT shade.spv
    COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.3 -I${ZVO_GLSL_INCLUDE_DIR} -o shade.spv
            ${CMAKE_CURRENT_LIST_DIR}/shade.comp
    DEPENDS ${CMAKE_CURRENT_LIST_DIR}/shade.comp zvo::glsl
    VERBATIM)
add_executable(consumer ${CMAKE_CURRENT_LIST_DIR}/main.cpp shade.spv)
target_link_libraries(consumer PRIVATE zvo::zvo zvo::glsl ${CMAKE_DL_LIBS})
target_compile_options(consumer PRIVATE -Wall -Wextra -Werror)

set(examples ${CMAKE_CURRENT_LIST_DIR}/../../../examples)
file(GLOB example_sources ${examples}/common/*.cpp)
add_executable(embed_minimal ${examples}/embed_minimal/main.cpp ${example_sources})
target_include_directories(embed_minimal PRIVATE ${examples})
target_link_libraries(embed_minimal PRIVATE zvo::zvo ${CMAKE_DL_LIBS})
