# The installed library: headers, library, and the files by which CMake and pkg-config find them.
# All paths are relative to those files: the prefix may be moved.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(curvewise_cmakedir ${CMAKE_INSTALL_LIBDIR}/cmake/curvewise)
target_include_directories(curvewise SYSTEM INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_sources(curvewise_fortran INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/curvewise/curvewise.f90>)
set_target_properties(curvewise_fortran PROPERTIES EXPORT_NAME fortran)

install(TARGETS curvewise curvewise_fortran EXPORT curvewise
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/curvewise DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY fortran/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/curvewise)

install(EXPORT curvewise NAMESPACE curvewise:: DESTINATION ${curvewise_cmakedir}
  FILE curvewiseTargets.cmake)
# What a C or Fortran compiler must add to link a static library that is C++ inside.
set(curvewise_runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER curvewise_runtime INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|c\\+\\+abi|m)$")
list(REMOVE_DUPLICATES curvewise_runtime)
configure_package_config_file(cmake/curvewiseConfig.cmake.in curvewiseConfig.cmake
  INSTALL_DESTINATION ${curvewise_cmakedir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(curvewiseConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/curvewiseConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/curvewiseConfigVersion.cmake
  DESTINATION ${curvewise_cmakedir})

set(curvewise_pc_cflags)
set(curvewise_pc_libs)
if(curvewise_type STREQUAL STATIC_LIBRARY)
  set(runtime ${curvewise_runtime})
  list(TRANSFORM runtime PREPEND " -l")
  list(JOIN runtime "" curvewise_pc_libs)
  string(APPEND curvewise_pc_libs " ${CMAKE_THREAD_LIBS_INIT}")
else()
  set(curvewise_pc_cflags " -DCURVEWISE_SHARED")
endif()
file(RELATIVE_PATH curvewise_pc_prefix
  ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH curvewise_pc_libdir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH curvewise_pc_includedir
  ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
configure_file(cmake/curvewise.pc.in curvewise.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/curvewise.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
