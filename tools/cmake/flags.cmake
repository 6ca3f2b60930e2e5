# SPDX-License-Identifier: MIT
# Compiler flags of every target of this project. Consumers inherit none of them.

# jointcal_set_flags(TARGET): C99 without extensions, the warnings, and arithmetic that gives the same bits everywhere.
function(jointcal_set_flags target)
    set_target_properties(${target} PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
    # -ffp-contract=off is not a matter of taste: fused multiply-adds would make results differ between targets.
    target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno -ffunction-sections -fdata-sections)
    # lib/math/clear.h is a loop because C libraries built for size have a slow memset; GCC would make a call of memset of it.
    if(CMAKE_CROSSCOMPILING)
        target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:C,GNU>:-fno-tree-loop-distribute-patterns>)
    endif()
    target_compile_options(${target} PRIVATE
        -Wall -Wextra -pedantic -Wconversion -Wsign-conversion -Wdouble-promotion -Wshadow -Wundef -Wcast-align
        -Wvla
        $<$<COMPILE_LANGUAGE:C>:-Wmissing-prototypes> $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes>)
    if(JOINTCAL_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
endfunction()

# 32-bit x86 would otherwise compute in 80-bit registers and round differently from every other target.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(i.86|x86|x86_64|AMD64)$" AND CMAKE_SIZEOF_VOID_P EQUAL 4)
    add_compile_options(-msse2 -mfpmath=sse)
endif()

if(JOINTCAL_SANITIZE)
    set(sanitizers -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all)
    add_compile_options(${sanitizers} -fno-omit-frame-pointer)
    add_link_options(${sanitizers})
endif()
if(JOINTCAL_COVERAGE)
    add_compile_options(--coverage)
    add_link_options(--coverage)
endif()
