# cmake --install: reed::core (the controller, Eigen only) with its reed::math, and reed::law (reed/law.h) for find_package(reed CONFIG).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/reed)
set_target_properties(reed_core PROPERTIES EXPORT_NAME core)
set_target_properties(reed_math PROPERTIES EXPORT_NAME math)
set_target_properties(reed_law_interface PROPERTIES EXPORT_NAME law)
set_target_properties(reed_law_names PROPERTIES EXPORT_NAME law_names)
target_include_directories(reed_law_interface INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(reed_core INTERFACE cxx_std_20)
target_compile_options(reed_math INTERFACE $<INSTALL_INTERFACE:${REED_SAME_BITS_FLAGS}>)
target_compile_definitions(reed_math INTERFACE $<INSTALL_INTERFACE:${REED_SAME_BITS_DEFINITIONS}>)
install(TARGETS reed_core reed_law_interface reed_law_names reed_math EXPORT reed)
install(EXPORT reed NAMESPACE reed:: FILE reedTargets.cmake DESTINATION ${package_dir})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/firmware/core/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/reed/core
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${REED_LAWS_DIR}/laws ${REED_LAWS_DIR}/law_names DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/reed FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/math/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/reed/math FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_SOURCE_DIR}/firmware/law_interface/law.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/reed)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/reedConfig.cmake @ONLY CONTENT [[
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
include(${CMAKE_CURRENT_LIST_DIR}/reedTargets.cmake)
]])
# Headers of one minor version fit the programs of that version: before 1.0 another minor version is another interface.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/reedConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_BINARY_DIR}/reedConfig.cmake ${CMAKE_BINARY_DIR}/reedConfigVersion.cmake DESTINATION ${package_dir})
