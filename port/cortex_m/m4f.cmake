# SPDX-License-Identifier: MIT
# Toolchain file: Cortex-M4 with single precision FPU, run on QEMU's mps2-an386.
set(JOINTCAL_CPU_FLAGS "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16")
set(JOINTCAL_QEMU_MACHINE mps2-an386)
set(JOINTCAL_FLASH 0x00000000)
set(JOINTCAL_RAM 0x20000000)
include(${CMAKE_CURRENT_LIST_DIR}/toolchain.cmake)
