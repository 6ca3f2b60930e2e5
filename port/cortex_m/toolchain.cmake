# SPDX-License-Identifier: MIT
# What the Cortex-M toolchain files share: arm-none-eabi-gcc, picolibc, semihosting, QEMU for running.
#
# Each of them sets JOINTCAL_CPU_FLAGS, JOINTCAL_QEMU_MACHINE, JOINTCAL_FLASH and JOINTCAL_RAM first. An outside project may
# use them as its CMAKE_TOOLCHAIN_FILE; for a board of one's own, give -D JOINTCAL_TARGET_LINK_FLAGS="..." instead of these.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_AR arm-none-eabi-gcc-ar)
set(CMAKE_RANLIB arm-none-eabi-gcc-ranlib)
set(CMAKE_NM arm-none-eabi-nm)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

if(NOT DEFINED JOINTCAL_MEMORY_SIZE)
    set(JOINTCAL_MEMORY_SIZE 0x400000)
endif()
if(NOT DEFINED JOINTCAL_STACK_SIZE)
    set(JOINTCAL_STACK_SIZE 0x10000)
endif()
# picolibcpp.ld is picolibc.ld with the tables of the unwinder, which some C++ programs link.
if(NOT DEFINED JOINTCAL_TARGET_LINK_FLAGS)
    string(CONCAT JOINTCAL_TARGET_LINK_FLAGS
        "--crt0=hosted --oslib=semihost -Tpicolibcpp.ld -Wl,--gc-sections "
        "-Wl,--defsym=__flash=${JOINTCAL_FLASH},--defsym=__flash_size=${JOINTCAL_MEMORY_SIZE} "
        "-Wl,--defsym=__ram=${JOINTCAL_RAM},--defsym=__ram_size=${JOINTCAL_MEMORY_SIZE} "
        "-Wl,--defsym=__stack_size=${JOINTCAL_STACK_SIZE}")
endif()
set(CMAKE_C_FLAGS_INIT "--specs=picolibc.specs ${JOINTCAL_CPU_FLAGS}")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")
set(CMAKE_EXE_LINKER_FLAGS_INIT "${JOINTCAL_TARGET_LINK_FLAGS}")
set(CMAKE_C_FLAGS_RELEASE_INIT "-O2 -DNDEBUG")
set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "Flags of Release builds")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "Flags of Release builds")

# CTest runs programs through this; a program's exit status is its own.
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/run_qemu.sh ${JOINTCAL_QEMU_MACHINE})

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
