# SPDX-License-Identifier: MIT
# zvo_package_part(TARGET): the objects of that static library go into the installed libraries, static and shared. What
# these export is what is marked so (include/zvo/export.h). The preset release optimizes programs less, where it does not
# show, as that takes a quarter of the compiler's time.
function(zvo_package_part target)
    set_target_properties(${target} PROPERTIES
        POSITION_INDEPENDENT_CODE ON
        CXX_VISIBILITY_PRESET hidden
        VISIBILITY_INLINES_HIDDEN ON)
    # Constants of templates are global to the whole process otherwise, however hidden.
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-ffunction-sections;-fdata-sections>
                                             $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-O2>
                                             $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-gnu-unique>)
endfunction()
