# What a library instantiates of Eigen stays its own: a program's instances, compiled with other flags,
# would otherwise take its place. No object defines or asks for any.
cmake_minimum_required(VERSION 3.22)
list(LENGTH OBJECTS count)
if(count LESS 10)
  message(FATAL_ERROR "these are not the libraries' objects: ${OBJECTS}")
endif()
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} --extern-only --format=posix ${object}
                  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]*5Eigen[^\n]*" found "${symbols}")
  if(found)
    message(FATAL_ERROR "${object} shares ${found}")
  endif()
endforeach()
