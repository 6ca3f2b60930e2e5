# SPDX-License-Identifier: MIT
# Toolchain file: Cortex-M3, no FPU: floating point in software, run on QEMU's mps2-an385.
set(JOINTCAL_CPU_FLAGS "-mcpu=cortex-m3 -mthumb -mfloat-abi=soft")
set(JOINTCAL_QEMU_MACHINE mps2-an385)
set(JOINTCAL_FLASH 0x00000000)
set(JOINTCAL_RAM 0x20000000)
include(${CMAKE_CURRENT_LIST_DIR}/toolchain.cmake)
