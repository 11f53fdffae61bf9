# SPDX-License-Identifier: MIT
# zvo_package_part(TARGET): the objects of that static library go into the installed libraries, static and shared. What
# these export is what is marked so (include/zvo/export.h). ZVO_LIBRARY_OPTIONS: the presets compile programs with -O1, as
# kernels take the time, and what hosts link with -O2.
function(zvo_package_part target)
    set_target_properties(${target} PROPERTIES
        POSITION_INDEPENDENT_CODE ON
        CXX_VISIBILITY_PRESET hidden
        VISIBILITY_INLINES_HIDDEN ON)
    # Constants of templates are global to the whole process otherwise, however hidden.
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-ffunction-sections;-fdata-sections>
                                             $<$<COMPILE_LANGUAGE:CXX>:${ZVO_LIBRARY_OPTIONS}>
                                             $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-gnu-unique>)
endfunction()
