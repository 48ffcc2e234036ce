set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()
# -O3 costs a tenth more build time than -O2 and gains nothing where the time goes: in shaders and in VTK.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

find_package(Threads REQUIRED)

# voxsheet_warnings(TARGET): the warnings every target of ours is compiled with; all are errors.
function(voxsheet_warnings target)
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU) # clang builds the fuzzers only; its opinions differ
        target_compile_options(${target} PRIVATE -Wall)
        return()
    endif()
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wnon-virtual-dtor -Werror)
    # GCC 12 reports false positives from inlined standard-library code under sanitizers and at -O3.
    target_compile_options(${target} PRIVATE -Wno-error=maybe-uninitialized -Wno-error=stringop-overflow
        -Wno-error=array-bounds -Wno-error=restrict -Wno-error=stringop-overread -Wno-error=dangling-pointer)
endfunction()

if(VOXSHEET_SANITIZE)
    add_compile_options(-fsanitize=${VOXSHEET_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${VOXSHEET_SANITIZE})
endif()
