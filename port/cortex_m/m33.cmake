# SPDX-License-Identifier: MIT
# Toolchain file: Cortex-M33 with single precision FPU, run on QEMU's mps2-an505.
set(JOINTCAL_CPU_FLAGS "-mcpu=cortex-m33 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16")
set(JOINTCAL_QEMU_MACHINE mps2-an505)
set(JOINTCAL_FLASH 0x10000000)
set(JOINTCAL_RAM 0x38000000)
include(${CMAKE_CURRENT_LIST_DIR}/toolchain.cmake)
