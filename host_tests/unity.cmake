# SPDX-License-Identifier: MIT
# Target `unity`: from the folder UNITY_ROOT, else an installed package, else the upstream release.
set(UNITY_ROOT "" CACHE PATH "Folder with unity.c, unity.h and unity_internals.h")

function(jointcal_unity_from folder)
    add_library(unity STATIC ${folder}/unity.c)
    target_include_directories(unity SYSTEM PUBLIC ${folder})
    target_compile_definitions(unity PUBLIC UNITY_INCLUDE_DOUBLE)
endfunction()

# tools/maintain/unity.sh leaves Unity here; a plain `cmake --preset host` after it then needs no variable.
if(NOT UNITY_ROOT AND EXISTS ${PROJECT_SOURCE_DIR}/build/unity/unity.c)
    set(UNITY_ROOT ${PROJECT_SOURCE_DIR}/build/unity)
endif()

if(UNITY_ROOT)
    jointcal_unity_from(${UNITY_ROOT})
    return()
endif()
find_package(unity CONFIG QUIET)
if(TARGET unity::framework)
    add_library(unity INTERFACE)
    target_link_libraries(unity INTERFACE unity::framework)
    return()
endif()

# Downloaded by hand first, because FetchContent ends the configuration where there is no way to the release: then the
# unit tests are left out, with a warning, and everything else still builds.
set(unity_release ${PROJECT_BINARY_DIR}/unity-2.6.1.tar.gz)
set(unity_sha256 b41a66d45a6b99758fb3202ace6178177014d52fc524bf1f72687d93e9867292)
if(NOT EXISTS ${unity_release})
    file(DOWNLOAD https://github.com/ThrowTheSwitch/Unity/archive/refs/tags/v2.6.1.tar.gz ${unity_release}.part
         STATUS unity_status TIMEOUT 60 INACTIVITY_TIMEOUT 10)
    list(GET unity_status 0 unity_status)
    # What comes back from where there is no way to the release may be a page that says so.
    set(unity_found "")
    if(unity_status EQUAL 0)
        file(SHA256 ${unity_release}.part unity_found)
    endif()
    if(NOT unity_found STREQUAL unity_sha256)
        message(WARNING "Unity is not to be had: no unit tests. tools/maintain/unity.sh fetches it, or set UNITY_ROOT.")
        return()
    endif()
    file(RENAME ${unity_release}.part ${unity_release})
endif()
include(FetchContent)
# The upstream project is only unpacked: its own build files are not ours to configure.
FetchContent_Declare(unity_release URL ${unity_release} URL_HASH SHA256=${unity_sha256} SOURCE_SUBDIR none)
FetchContent_MakeAvailable(unity_release)
jointcal_unity_from(${unity_release_SOURCE_DIR}/src)
