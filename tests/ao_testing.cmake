add_library(ao_test_main OBJECT support/main.cpp)
target_link_libraries(ao_test_main PUBLIC Catch2::Catch2 ao ao_strict_fp)
# Nothing in it is timed, and optimising Catch2 takes minutes.
target_compile_options(ao_test_main PRIVATE -O0)

# Leaks inside Mesa, LLVM and the Vulkan loader are not ours; everything else counts.
set(AO_TEST_ENVIRONMENT
    "LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_SOURCE_DIR}/support/leaks.txt:print_suppressions=0"
    "UBSAN_OPTIONS=print_stacktrace=1")

# ao_add_test(name SOURCES … [LIBS …] [LABELS …] [TIMEOUT seconds])
# A Catch2 program test_<name>, one CTest entry. tests/ is on its include path ("support/…").
function(ao_add_test name)
    cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LIBS;LABELS" ${ARGN})
    if(NOT arg_TIMEOUT)
        set(arg_TIMEOUT 600)
    endif()
    add_executable(test_${name} ${arg_SOURCES})
    target_include_directories(test_${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
    target_link_libraries(test_${name} PRIVATE ao_test_main ${arg_LIBS} ao_warnings)
    add_test(NAME ${name} COMMAND test_${name})
    set_tests_properties(${name} PROPERTIES
        LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT} ENVIRONMENT "${AO_TEST_ENVIRONMENT}")
endfunction()

# ao_add_must_fail(name source regex [LIBS …])
# The source must compile as it stands, and must not with AO_MISUSE defined; then the compiler must say `regex`.
function(ao_add_must_fail name source regex)
    cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
    add_library(must_fail_${name} OBJECT ${source})
    target_link_libraries(must_fail_${name} PRIVATE ao ${arg_LIBS})
    add_test(NAME must_fail_${name}
        COMMAND "${CMAKE_COMMAND}" "-DCOMMANDS=${PROJECT_BINARY_DIR}/compile_commands.json"
                "-DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/${source}" "-DREGEX=${regex}"
                -P "${PROJECT_SOURCE_DIR}/tests/must_fail/must_fail.cmake")
    set_tests_properties(must_fail_${name} PROPERTIES LABELS must_fail)
endfunction()

# One translation unit per installed header, which holds nothing but that header, twice; all of them linked together,
# so that a definition without `inline` is found as well.
function(ao_add_header_test)
    set(sources "")
    set(libs ao ao_conformance)
    set(roots include)
    foreach(component IN ITEMS cpu gl vk)
        if(TARGET ao_${component})
            list(APPEND libs ao_${component})
            list(APPEND roots backends/${component}/include)
        endif()
    endforeach()
    foreach(root IN LISTS roots)
        file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/${root}"
             "${PROJECT_SOURCE_DIR}/${root}/*.hpp")
        foreach(header IN LISTS headers)
            string(MAKE_C_IDENTIFIER "${header}" unit)
            set(unit "${CMAKE_CURRENT_BINARY_DIR}/headers_alone/${unit}.cpp")
            file(CONFIGURE OUTPUT "${unit}" CONTENT "#include \"${header}\"\n#include \"${header}\"\n")
            list(APPEND sources "${unit}")
        endforeach()
    endforeach()
    if(sources)
        file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/headers_alone/main.cpp" CONTENT "int main() {}\n")
        add_executable(test_headers_alone ${sources} "${CMAKE_CURRENT_BINARY_DIR}/headers_alone/main.cpp")
        target_link_libraries(test_headers_alone PRIVATE ${libs} ao_warnings)
        add_test(NAME headers_alone COMMAND test_headers_alone)
        set_tests_properties(headers_alone PROPERTIES LABELS static)
    endif()
endfunction()

# ao_add_consumers(component…): the project of tests/consumers/KIND against these components.
function(ao_add_consumers)
    set(flags "${CMAKE_CXX_FLAGS}")
    if(AO_SANITIZE)
        string(APPEND flags " -fsanitize=${AO_SANITIZE}")
    endif()
    if(AO_COVERAGE)
        string(APPEND flags " --coverage")
    endif()
    list(JOIN ARGN "|" components)
    foreach(kind IN ITEMS find_package add_subdirectory)
        set(build_tree "")
        if(kind STREQUAL "find_package")
            set(build_tree "${PROJECT_BINARY_DIR}")
        endif()
        add_test(NAME consumer_${kind}
            COMMAND "${CMAKE_COMMAND}" "-DPROJECT=${CMAKE_CURRENT_SOURCE_DIR}/consumers/${kind}"
                    "-DDIR=${CMAKE_CURRENT_BINARY_DIR}/consumers/${kind}" "-DBUILD_TREE=${build_tree}"
                    "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DCOMPONENTS=${components}" "-DCOMPILER=${CMAKE_CXX_COMPILER}"
                    "-DFLAGS=${flags}" -P "${CMAKE_CURRENT_SOURCE_DIR}/consumers/consumer.cmake")
        set_tests_properties(consumer_${kind} PROPERTIES
            LABELS consumers TIMEOUT 1200 ENVIRONMENT "${AO_TEST_ENVIRONMENT}")
    endforeach()
endfunction()
