# For targets of another system: the headers of nlohmann-json and doctest are this machine's, but what
# lies beside them in /usr/include is not for the target. So both are found in a folder of links. Given
# to CMake as CMAKE_PROJECT_devlearn_INCLUDE.
foreach(library nlohmann_json doctest)
  if(library STREQUAL "doctest" AND NOT DEVLEARN_TESTS)
    continue()
  endif()
  find_package(${library} REQUIRED)
  get_target_property(include ${library}::${library} INTERFACE_INCLUDE_DIRECTORIES)
  list(GET include 0 include)
  string(REGEX REPLACE "_.*" "" folder ${library})
  set(links ${CMAKE_BINARY_DIR}/host_headers)
  file(MAKE_DIRECTORY ${links})
  file(CREATE_LINK ${include}/${folder} ${links}/${folder} SYMBOLIC)
  set_target_properties(${library}::${library} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${links})
endforeach()
