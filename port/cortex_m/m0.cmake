# SPDX-License-Identifier: MIT
# Toolchain file: Cortex-M0, no FPU. Its programs run on QEMU's Cortex-M3 (mps2-an385), which knows all instructions of the M0,
# because tests need more RAM than the emulated Cortex-M0 has (microbit, 16 KiB); tools/same_bits.py runs the engine on that one.
set(JOINTCAL_CPU_FLAGS "-mcpu=cortex-m0 -mthumb -mfloat-abi=soft")
set(JOINTCAL_QEMU_MACHINE mps2-an385)
set(JOINTCAL_FLASH 0x00000000)
set(JOINTCAL_RAM 0x20000000)
include(${CMAKE_CURRENT_LIST_DIR}/toolchain.cmake)
