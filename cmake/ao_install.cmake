include(CMakePackageConfigHelpers)

# ao_backend(NAME cpu SOURCES … [LIBS …] [PRIVATE_LIBS …] [DEPENDS "TBB" "Vulkan"])
# Makes the static library ao_NAME (alias ao::NAME), a component of the package. Its public headers lie in
# include/ of the calling directory. LIBS are public; PRIVATE_LIBS that are real libraries belong in DEPENDS too
# (arguments of find_dependency), because whoever links a static library must find them.
function(ao_backend)
    cmake_parse_arguments(arg "" "NAME" "SOURCES;LIBS;PRIVATE_LIBS;DEPENDS" ${ARGN})
    set(target ao_${arg_NAME})
    add_library(${target} STATIC ${arg_SOURCES})
    add_library(ao::${arg_NAME} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_NAME} POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${target} PUBLIC
        "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>"
        "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
    target_link_libraries(${target}
        PUBLIC ao ${arg_LIBS}
        PRIVATE ao_strict_fp ${arg_PRIVATE_LIBS} $<BUILD_INTERFACE:ao_warnings>)
    set_property(GLOBAL APPEND PROPERTY AO_COMPONENTS ${arg_NAME})
    set_property(GLOBAL PROPERTY AO_COMPONENT_${arg_NAME}_DEPENDS "${arg_DEPENDS}")
    set_property(GLOBAL PROPERTY AO_COMPONENT_${arg_NAME}_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
endfunction()

function(ao_install_package)
    set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/ao")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(TARGETS ao ao_strict_fp ao_conformance EXPORT ao_core)
    install(EXPORT ao_core NAMESPACE ao:: FILE ao-core.cmake DESTINATION "${package_dir}")

    get_property(components GLOBAL PROPERTY AO_COMPONENTS)
    set(AO_COMPONENT_DEPENDENCIES "")
    foreach(component IN LISTS components)
        get_property(dir GLOBAL PROPERTY AO_COMPONENT_${component}_DIR)
        if(EXISTS "${dir}/include")
            install(DIRECTORY "${dir}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
        endif()
        install(TARGETS ao_${component} EXPORT ao_${component})
        install(EXPORT ao_${component} NAMESPACE ao:: FILE ao-${component}.cmake DESTINATION "${package_dir}")
        get_property(depends GLOBAL PROPERTY AO_COMPONENT_${component}_DEPENDS)
        string(APPEND AO_COMPONENT_DEPENDENCIES "set(_ao_${component}_depends \"${depends}\")\n")
    endforeach()

    configure_file("${PROJECT_SOURCE_DIR}/cmake/ao-config.cmake.in" "${PROJECT_BINARY_DIR}/ao-config.cmake" @ONLY)
    write_basic_package_version_file("${PROJECT_BINARY_DIR}/ao-config-version.cmake" COMPATIBILITY SameMinorVersion)
    install(FILES "${PROJECT_BINARY_DIR}/ao-config.cmake" "${PROJECT_BINARY_DIR}/ao-config-version.cmake"
            DESTINATION "${package_dir}")
endfunction()
