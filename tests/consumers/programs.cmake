# What both consumers build: one program for the core, and for each component named in AO_COMPONENTS the example that the
# README shows, linked against that component alone.
set(programs "${CMAKE_CURRENT_LIST_DIR}")
enable_testing()
add_executable(core "${programs}/core.cpp")
target_link_libraries(core PRIVATE ao::ao)
add_test(NAME core COMMAND core)
foreach(component IN LISTS AO_COMPONENTS)
    add_executable(${component} "${programs}/links.cpp" "${programs}/../../docs/examples/${component}.cpp")
    target_link_libraries(${component} PRIVATE ao::${component})
    add_test(NAME ${component} COMMAND ${component})
endforeach()
