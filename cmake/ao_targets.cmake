find_package(glm 0.9.9 REQUIRED)

add_library(ao INTERFACE)
add_library(ao::ao ALIAS ao)
target_compile_features(ao INTERFACE cxx_std_20)
target_include_directories(ao INTERFACE
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
target_link_libraries(ao INTERFACE glm::glm)

# For users who need the host's results to equal the shaders' bit for bit: a fused multiply-add rounds once where
# the shaders round twice.
add_library(ao_strict_fp INTERFACE)
add_library(ao::strict_fp ALIAS ao_strict_fp)
set_target_properties(ao_strict_fp PROPERTIES EXPORT_NAME strict_fp)
target_compile_options(ao_strict_fp INTERFACE
    "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>"
    "$<$<CXX_COMPILER_ID:MSVC>:/fp:precise>")

add_library(ao_conformance INTERFACE)
add_library(ao::conformance ALIAS ao_conformance)
set_target_properties(ao_conformance PROPERTIES EXPORT_NAME conformance)
target_link_libraries(ao_conformance INTERFACE ao ao_strict_fp)

# Internal: link it PRIVATE and as $<BUILD_INTERFACE:ao_warnings>, so that it never reaches a user.
add_library(ao_warnings INTERFACE)
target_compile_options(ao_warnings INTERFACE
    "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wno-sign-conversion;-Wdouble-promotion;-Wnon-virtual-dtor;-Wundef>"
    "$<$<AND:$<BOOL:${AO_WERROR}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>"
    "$<$<CXX_COMPILER_ID:MSVC>:/W4>")
