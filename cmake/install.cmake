# Installs the libraries with what find_package and pkg-config need. Each is an install component of
# its name: `cmake --install build --component core` is the learner alone. Nothing that is installed
# holds an absolute path, so the tree may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(devlearn_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/devlearn)

# A library, and its headers, which lie in include/.
function(devlearn_install name)
  install(TARGETS devlearn_${name} EXPORT devlearn-${name}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name}
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT devlearn-${name} NAMESPACE devlearn:: FILE devlearn-${name}.cmake
          DESTINATION ${devlearn_package_dir} COMPONENT ${name})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${name})

  # A static library leaves it to the program to link what it stands on; a shared one does not.
  set(requires "eigen3 >= 3.4")
  if(name STREQUAL "agents")
    set(requires "devlearn-core = ${PROJECT_VERSION}")
  elseif(name STREQUAL "tasks")
    set(requires "devlearn-agents = ${PROJECT_VERSION}")
  elseif(name STREQUAL "sim")
    set(requires "devlearn-agents = ${PROJECT_VERSION}")
    if(DEVLEARN_SIM_NEEDS_BOX2D)
      string(APPEND requires ", box2d >= 2.4.1")
    endif()
  endif()
  file(RELATIVE_PATH to_include ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/devlearn.pc.in devlearn-${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/devlearn-${name}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${name})
endfunction()

set(DEVLEARN_SIM_NEEDS_BOX2D ON)
if(BUILD_SHARED_LIBS)
  set(DEVLEARN_SIM_NEEDS_BOX2D OFF)
endif()
configure_package_config_file(cmake/devlearnConfig.cmake.in devlearnConfig.cmake
  INSTALL_DESTINATION ${devlearn_package_dir})
write_basic_package_version_file(devlearnConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/devlearnConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/devlearnConfigVersion.cmake
        DESTINATION ${devlearn_package_dir} COMPONENT core)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/devlearn COMPONENT core)
if(DEVLEARN_SIM)
  install(DIRECTORY python/devlearn/worlds
          DESTINATION ${CMAKE_INSTALL_DATADIR}/devlearn COMPONENT sim)
  install(FILES python/devlearn/world.schema.json python/devlearn/robot.schema.json
          DESTINATION ${CMAKE_INSTALL_DATADIR}/devlearn COMPONENT sim)
endif()
