# SPDX-License-Identifier: MIT
# Builds and runs consumer.c the way a user's project would. cmake -D KIND=... -P run.cmake
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        string(JOIN " " command ${ARGV})
        message(FATAL_ERROR "failed (${result}): ${command}\n${output}")
    endif()
endfunction()

function(build_with_cmake)
    run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/${KIND} -B ${WORK}/build -G ${GENERATOR}
        ${compiler} ${ARGV})
    run(${CMAKE_COMMAND} --build ${WORK}/build)
    run(${EMULATOR} ${WORK}/build/consumer)
endfunction()

# With TOOLCHAIN and EMULATOR: as a firmware project would, run on an emulated board.
set(compiler -D CMAKE_C_COMPILER=${CC})
if(TOOLCHAIN)
    set(compiler -D CMAKE_TOOLCHAIN_FILE=${TOOLCHAIN})
endif()

if(KIND STREQUAL "add_subdirectory")
    build_with_cmake(-D JOINTCAL_SOURCE=${SOURCE})
    return()
endif()

# The tree is installed and then moved: nothing in it may remember where it was.
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
file(RENAME ${WORK}/installed ${WORK}/moved)
if(KIND STREQUAL "find_package")
    build_with_cmake(-D CMAKE_PREFIX_PATH=${WORK}/moved)
    return()
endif()

find_program(pkg_config NAMES pkg-config pkgconf)
if(NOT pkg_config)
    message("SKIPPED: no pkg-config")
    return()
endif()
set(ENV{PKG_CONFIG_PATH} ${WORK}/moved/${LIBDIR}/pkgconfig)
execute_process(COMMAND ${pkg_config} --static --cflags --libs jointcal OUTPUT_VARIABLE flags
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags)
run(${CC} -std=c99 ${CMAKE_CURRENT_LIST_DIR}/consumer.c -o ${WORK}/consumer ${flags})
run(${WORK}/consumer)
