# Install the built library below the build tree, build the downstream project
# against it with nothing else to find it by, and run the program.
#
# cmake -DBINARY_DIR=<build tree> -DSOURCE_DIR=<this directory>
#       -DGENERATOR=<generator> -P run.cmake

set(_prefix "${BINARY_DIR}/tests/downstream/prefix")
set(_build "${BINARY_DIR}/tests/downstream/build")
file(REMOVE_RECURSE "${_prefix}" "${_build}")

foreach(_component library headers)
  execute_process(
    COMMAND ${CMAKE_COMMAND} --install "${BINARY_DIR}" --prefix "${_prefix}"
            --component ${_component}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
# Debug or Release does not matter: the package says which deal.II it needs.
execute_process(
  COMMAND ${CMAKE_COMMAND} -S "${SOURCE_DIR}" -B "${_build}" -G "${GENERATOR}"
          "-DCMAKE_PREFIX_PATH=${_prefix}" -DCMAKE_CXX_FLAGS=-Werror
          "-DREADME=${SOURCE_DIR}/../../README.md"
          COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build "${_build}"
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${_build}/downstream" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${_build}/readme" OUTPUT_VARIABLE _stress
                COMMAND_ERROR_IS_FATAL ANY)
if(NOT _stress MATCHES "stress beside the bore")
  message(FATAL_ERROR "README's program printed '${_stress}'")
endif()
