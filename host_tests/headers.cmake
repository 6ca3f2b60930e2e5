# SPDX-License-Identifier: MIT
# Every public header compiles alone, twice in a row, as C99 and as C++11.
include(CheckLanguage)
# A target's C++ needs a standard library of its own; the headers are the same ones.
if(NOT CMAKE_CROSSCOMPILING)
    check_language(CXX)
endif()
if(CMAKE_CXX_COMPILER)
    enable_language(CXX)
endif()

file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/include/jointcal/*.h)
foreach(header IN LISTS headers)
    get_filename_component(name ${header} NAME_WE)
    set(text "#include \"${header}\"\n#include \"${header}\"\nint jcal_test_${name}(void);\n")
    string(APPEND text "int jcal_test_${name}(void)\n{\n    return 0;\n}\n")
    foreach(language c cpp)
        # configure_file style writing: the time stamp changes only when the text does.
        file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.${language} CONTENT "${text}" @ONLY)
        list(APPEND header_sources_${language} ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.${language})
    endforeach()
endforeach()

add_library(headers_c99 OBJECT ${header_sources_c})
target_link_libraries(headers_c99 PRIVATE jointcal::jointcal)
jointcal_set_flags(headers_c99)
if(CMAKE_CXX_COMPILER)
    add_library(headers_cxx11 OBJECT ${header_sources_cpp})
    target_link_libraries(headers_cxx11 PRIVATE jointcal::jointcal)
    set_target_properties(headers_cxx11 PROPERTIES CXX_STANDARD 11 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
    target_compile_options(headers_cxx11 PRIVATE -Wall -Wextra -pedantic -Wconversion -Wshadow -Wundef -Werror)

    # The C++ program also links: a header without extern "C" would compile and fail only here.
    add_executable(use_from_cxx consumer/use_from_cxx.cpp)
    target_link_libraries(use_from_cxx PRIVATE jointcal::jointcal)
    set_target_properties(use_from_cxx PROPERTIES CXX_STANDARD 11 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
    add_test(NAME use_from_cxx COMMAND use_from_cxx)
endif()
