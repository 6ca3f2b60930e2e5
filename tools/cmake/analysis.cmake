# SPDX-License-Identifier: MIT
# Targets format_check, tidy and cppcheck. They exist where their tool does; tools/test.sh installs and builds them all.
set(analysis_folders include lib tools/cli tools/example host_tests/unit host_tests/program host_tests/consumer host_tests/fuzz tools/native
    host_tests/bench host_tests/hub port/hub host_tests/vqf port/vqf)
set(format_patterns ${analysis_folders} port/cortex_m port/boards)
set(source_patterns ${analysis_folders})
list(TRANSFORM format_patterns APPEND "/*.[ch]")
list(TRANSFORM source_patterns APPEND "/*.c")
file(GLOB_RECURSE format_files CONFIGURE_DEPENDS ${format_patterns})
file(GLOB_RECURSE source_files CONFIGURE_DEPENDS ${source_patterns})
list(APPEND format_files ${PROJECT_SOURCE_DIR}/port/vqf/jcal_vqf.cpp)
# Code for microcontrollers and for QEMU, which no build for the PC compiles: read with these flags.
set(port_patterns port/cortex_m/*.c port/boards/*.c)
file(GLOB_RECURSE port_files CONFIGURE_DEPENDS ${port_patterns})
set(port_flags -std=gnu99 -I ${PROJECT_SOURCE_DIR}/include -I ${PROJECT_SOURCE_DIR}/port/hub -I ${PROJECT_SOURCE_DIR}/port/boards/common)
# Fuzz targets and the consumers' program are not part of this build, so nothing knows how to compile them.
list(FILTER source_files EXCLUDE REGEX "host_tests/(fuzz|consumer)/")
if(NOT TARGET jointcal_vqf)
    list(FILTER source_files EXCLUDE REGEX "host_tests/vqf/")
endif()

# Layout and findings differ between versions of the tools; one version decides.
find_program(JOINTCAL_CLANG_FORMAT clang-format-14)
find_program(JOINTCAL_CLANG_TIDY clang-tidy-14)
find_program(JOINTCAL_CPPCHECK cppcheck)
mark_as_advanced(JOINTCAL_CLANG_FORMAT JOINTCAL_CLANG_TIDY JOINTCAL_CPPCHECK)
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)

if(JOINTCAL_CLANG_FORMAT)
    add_custom_target(format_check COMMAND ${JOINTCAL_CLANG_FORMAT} --dry-run --Werror ${format_files} VERBATIM)
    add_custom_target(format COMMAND ${JOINTCAL_CLANG_FORMAT} -i ${format_files} VERBATIM)
endif()
if(JOINTCAL_CLANG_TIDY)
    add_custom_target(tidy
        COMMAND ${PROJECT_SOURCE_DIR}/tools/maintain/tidy.sh ${JOINTCAL_CLANG_TIDY} ${PROJECT_BINARY_DIR}
                ${processors} ${source_files}
        COMMAND ${JOINTCAL_CLANG_TIDY} --quiet ${port_files} -- ${port_flags}
        VERBATIM)
endif()
if(JOINTCAL_CPPCHECK)
    add_custom_target(cppcheck
        COMMAND ${JOINTCAL_CPPCHECK} --quiet --std=c99 --error-exitcode=1 --inline-suppr -j ${processors}
                --enable=warning,performance,portability --suppress=missingIncludeSystem -U JCAL_CONFIG_HEADER
                --suppress=*:*/unity/* -I ${PROJECT_SOURCE_DIR}/include -I ${PROJECT_SOURCE_DIR}/lib
                -I ${PROJECT_SOURCE_DIR}/tools/cli -I ${PROJECT_SOURCE_DIR}/port/hub -I ${PROJECT_SOURCE_DIR}/host_tests -I ${PROJECT_SOURCE_DIR}/port/vqf
                -I ${PROJECT_SOURCE_DIR}/port/boards/common ${source_files} ${port_files}
        VERBATIM)
endif()
