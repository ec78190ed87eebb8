# What `cmake --install` puts where: libraries, headers, package config, program, assets, goldens.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tumble)
set(libraries tumble_sim tumble_flags)
install(DIRECTORY sim DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tumble FILES_MATCHING PATTERN "*.h")
if(TUMBLE_RENDER)
  list(APPEND libraries tumble_render tumble_glad)
  install(DIRECTORY render DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tumble FILES_MATCHING PATTERN "*.h")
  install(DIRECTORY assets/shaders DESTINATION ${CMAKE_INSTALL_DATADIR}/tumble)
  install(DIRECTORY ${TUMBLE_FONT_DIR}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/tumble/fonts)
endif()
install(TARGETS ${libraries} EXPORT tumbleTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT tumbleTargets NAMESPACE tumble:: DESTINATION ${package_dir})
configure_package_config_file(cmake/tumbleConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/tumbleConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/tumbleConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tumbleConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/tumbleConfigVersion.cmake DESTINATION ${package_dir})
if(TUMBLE_APP)
  install(TARGETS tumble RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY assets/demos assets/report assets/meshes DESTINATION ${CMAKE_INSTALL_DATADIR}/tumble)
  install(DIRECTORY golden DESTINATION ${CMAKE_INSTALL_DATADIR}/tumble)
endif()
