# Build types and flags of this project's own code.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug or Release" FORCE)
endif()
if(NOT CMAKE_BUILD_TYPE MATCHES "^(Debug|Release)$")
  message(FATAL_ERROR
    "CMAKE_BUILD_TYPE is '${CMAKE_BUILD_TYPE}', but deal.II comes in two "
    "flavours only: choose Debug or Release.")
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

# deal.II comes with two hundred libraries: LLVM's linker needs 2 s for a program, gold 6 s and
# the usual one 30 s.
include(CheckLinkerFlag)
foreach(_linker lld gold)
  check_linker_flag(CXX -fuse-ld=${_linker} NMM_HAVE_LINKER_${_linker})
  if(NMM_HAVE_LINKER_${_linker})
    add_link_options(-fuse-ld=${_linker})
    break()
  endif()
endforeach()

# Nothing that depends on the machine that compiles (-march) and nothing that
# changes the meaning of floating-point arithmetic (-ffast-math): a library and
# the programs that link it must agree on both. Whoever wants them passes
# CMAKE_CXX_FLAGS, and then to deal.II too.
#
# The exact geometry is ten times slower without optimization and the debugger
# gets by with -Og.
set(NMM_FLAGS_DEBUG -Og -g1)
set(NMM_FLAGS_RELEASE -O3)
set(CMAKE_CXX_FLAGS_DEBUG "")
set(CMAKE_CXX_FLAGS_RELEASE "")

# Flags shared by the library, the programs and the tests, so that all of them
# can use one precompiled header.
add_library(nmm_options INTERFACE)
target_compile_options(
  nmm_options
  INTERFACE -fPIC
            -Wall
            -Wextra
            -Wpedantic
            # g++ 13 and 14 take a loop over a list of pairs for a reference to nothing.
            $<$<CXX_COMPILER_ID:GNU>:-Wno-dangling-reference>
            $<$<CONFIG:Debug>:${NMM_FLAGS_DEBUG}>
            $<$<CONFIG:Release>:${NMM_FLAGS_RELEASE}>
            $<$<BOOL:${NMM_WARNINGS_AS_ERRORS}>:-Werror>)
# Without MPI's C++ classes, which nobody uses, each source takes half a second less.
target_compile_definitions(
  nmm_options INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS> OMPI_SKIP_MPICXX
                        MPICH_SKIP_MPICXX)

# A run ends at the first finding. Libraries are instrumented as far as they are headers;
# CGAL's iterators cast the faces of an arrangement to a class that they are not of, hence
# no check of that (vptr).
if(NMM_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=vptr
                      -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# setup.sh has CMake compile several sources as one (CMAKE_UNITY_BUILD): most of the
# time of a source goes by with reading deal.II's headers, precompiled or not, and
# all of it takes half as long. Names in anonymous namespaces are therefore to differ
# within a target.
