# SPDX-License-Identifier: MIT
# What the library may not contain. A violation fails the build, not only a test.
find_package(Python3 COMPONENTS Interpreter)
if(NOT Python3_FOUND)
    message(WARNING "No Python 3: the library's sources and symbols are not checked, and tests that need it are left out.")
    return()
endif()

file(GLOB_RECURSE jointcal_checked CONFIGURE_DEPENDS lib/*.c lib/*.h include/*.h)
add_custom_command(
    OUTPUT ${PROJECT_BINARY_DIR}/sources_checked.stamp
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/maintain/check_sources.py ${jointcal_checked}
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/maintain/check_includes.py ${PROJECT_SOURCE_DIR}
    COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/sources_checked.stamp
    DEPENDS ${jointcal_checked} lib/layers.txt tools/maintain/check_sources.py tools/maintain/check_includes.py
    COMMENT "Checking the library's sources: banned words, recursion, length, who includes and calls whom" VERBATIM)

# Sanitizers and coverage counters add symbols and statics of their own.
set(jointcal_check_stamps ${PROJECT_BINARY_DIR}/sources_checked.stamp)
if(NOT JOINTCAL_SANITIZE AND NOT JOINTCAL_COVERAGE)
    add_custom_command(
        OUTPUT ${PROJECT_BINARY_DIR}/archive_checked.stamp
        COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/maintain/check_archive.py ${CMAKE_NM}
                $<TARGET_FILE:jointcal>
        COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/archive_checked.stamp
        DEPENDS jointcal tools/maintain/check_archive.py
        COMMENT "Checking the library's symbols: no heap, no I/O, no libm, no mutable statics" VERBATIM)
    list(APPEND jointcal_check_stamps ${PROJECT_BINARY_DIR}/archive_checked.stamp)
endif()
add_custom_target(jointcal_source_checks ALL DEPENDS ${jointcal_check_stamps})
