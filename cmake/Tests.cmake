# SPDX-License-Identifier: MIT
# Test binaries as ctest runs them, within the budgets of tests/budget.txt.

# About what a process takes at most on the reference machine. Processes that begin together compile the same kernels,
# each for itself, so they are few.
set(ZVO_SHARD_SECONDS 90)

# Binaries that the validation layers always watch: hosts of all kinds, and every kernel once. tests/limited says what
# they check of the others.
set(ZVO_ALWAYS_VALIDATED vk small example glsl deform)

# Binaries that begin before all others: one that compiles every kernel, for the driver's cache of all others, and beside
# it those that use none. Two that begin with the same kernels would compile them twice.
set(ZVO_FIRST small scene file oracle)

# What binaries may take, and the tests that only run in their large form or are left to scripts/test --all.
file(STRINGS ${PROJECT_SOURCE_DIR}/tests/budget.txt lines REGEX "^[a-z]")
foreach(line ${lines})
    string(REGEX MATCH "^([a-z_]+) +([0-9]+|-)( +([0-9]+))?" matched ${line})
    if(NOT matched)
        message(FATAL_ERROR "tests/budget.txt: ${line}")
    endif()
    set(zvo_budget_${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
    set(zvo_large_budget_${CMAKE_MATCH_1} ${CMAKE_MATCH_4})
endforeach()
file(STRINGS ${PROJECT_SOURCE_DIR}/tests/large.txt lines REGEX "^[a-z]")
foreach(line ${lines})
    if(line MATCHES "^([a-z_]+) +([^ ]+)")
        list(APPEND zvo_large_${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
    endif()
endforeach()
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/tests/budget.txt ${PROJECT_SOURCE_DIR}/tests/large.txt)
set_property(GLOBAL PROPERTY zvo_test_binaries "")

# What scripts/test runs, without --all.
add_custom_target(zvo_tests)

# zvo_add_shards(NAME TARGET LABELS SECONDS FILTER VARIABLE...): ctest runs TARGET as NAME1, NAME2 and so on: processes
# that share the tests of FILTER, in any order, each on one device of its own.
function(zvo_add_shards name target labels seconds filter)
    math(EXPR last "${seconds} / ${ZVO_SHARD_SECONDS}")
    math(EXPR shards "${last} + 1")
    math(EXPR cost "${seconds} / ${shards}")
    foreach(shard RANGE ${last})
        math(EXPR number "${shard} + 1")
        add_test(NAME ${name}${number}
            COMMAND ${PROJECT_SOURCE_DIR}/tests/limited ${name}${number} ${cost} $<TARGET_FILE:${target}>)
        set(order ${cost})
        list(TRANSFORM ZVO_FIRST APPEND . OUTPUT_VARIABLE first)
        if(name IN_LIST first)
            math(EXPR order "1000 + ${cost}")
        endif()
        set_tests_properties(${name}${number} PROPERTIES LABELS "${labels}" COST ${order}
            ENVIRONMENT "GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${shard};GTEST_SHUFFLE=1;GTEST_BRIEF=1;GTEST_FILTER=${filter};${ARGN}")
    endforeach()
endfunction()

# zvo_add_tests(zvo_NAME_tests LABELS SOURCE...): a test binary; link what it tests to it afterwards. ctest runs it as
# NAME.1, NAME.2 and so on, and its tests in tests/large.txt as NAME.large.1 and so on, which have the label large as
# well. docs/testing.md has the labels.
function(zvo_add_tests target labels)
    add_executable(${target} ${ARGN})
    set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 8) # names at file scope differ within these
    target_compile_options(${target} PRIVATE ${test_optimization})
    target_precompile_headers(${target} REUSE_FROM zvo_test_headers)
    target_link_libraries(${target} PRIVATE zvo_options zvo_test_support)
    string(REGEX REPLACE "^zvo_(.*)_tests$" "\\1" name ${target})
    set_property(GLOBAL APPEND PROPERTY zvo_test_binaries ${name})
    set(seconds ${zvo_budget_${name}})
    if("stress" IN_LIST labels)
        set(seconds ${zvo_large_budget_${name}}) # all of its tests take long
    else()
        add_dependencies(zvo_tests ${target})
    endif()
    if(NOT seconds)
        set(seconds 1) # Budget.* fails
    endif()
    set(left_out "")
    set(large "")
    foreach(pattern ${zvo_large_${name}})
        if(NOT pattern MATCHES "^[+]")
            list(APPEND left_out ${pattern})
        endif()
        string(REGEX REPLACE "^[+]" "" pattern ${pattern})
        list(APPEND large ${pattern})
    endforeach()
    list(JOIN left_out ":" left_out)
    list(JOIN large ":" large)
    if(left_out)
        set(left_out "-${left_out}")
    else()
        set(left_out "*")
    endif()
    set(layers ZVO_TEST_LAYERS_OPTIONAL=1)
    if("stress" IN_LIST labels OR name IN_LIST ZVO_ALWAYS_VALIDATED)
        set(layers "")
    endif()
    zvo_add_shards(${name}. ${target} "${labels}" ${seconds} "${left_out}" ${layers})
    if(large)
        set(seconds ${zvo_large_budget_${name}})
        if(NOT seconds)
            set(seconds 1)
        endif()
        zvo_add_shards(${name}.large. ${target} "${labels};large" ${seconds} "${large}" ZVO_TEST_FULL=1)
    endif()
endfunction()

# zvo_optimize_tests(TARGET): of tests that compute much on the host. Headers are precompiled without optimization.
function(zvo_optimize_tests target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
endfunction()
