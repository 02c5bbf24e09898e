# ao_add_shaders(TARGET t NAMESPACE x::y API vulkan|opengl SOURCES a.comp b.frag …
#                [INCLUDE_DIRS …] [DEFINES A B=1 …] [SUFFIX _s])
#
# Compiles GLSL while building and embeds it into target t. For each source, `dir/name.comp` say, the generated header
# "<t>_shaders.hpp" (namespace NAMESPACE) declares
#     extern const std::span<const std::uint32_t> name_comp_s;     SPIR-V
#     extern const std::string_view name_comp_s_text;              opengl only: the same shader as flattened GLSL
# A source that includes anything says `#extension GL_GOOGLE_include_directive : require` itself.
# SUFFIX tells apart several builds of one source with different DEFINES. include/ of the project is always searched.
#
# Specialisation constants are written as in any shader: `layout(constant_id = 3) const int taps = 32;` and
# `layout(local_size_x_id = 10) in;`. Flattened text has no such thing; there the constant's value is the macro
# AO_SPEC_3, which the host may define behind the first line (always #version) and which else is the default;
# AO_SPEC_10 has no default and must be defined.
#
# Every SPIR-V file is listed in the global property AO_SPIRV_FILES for the test of NoContraction.

include_guard(GLOBAL)
set(AO_SHADER_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}" CACHE INTERNAL "")
find_program(AO_GLSLANG NAMES glslangValidator glslang DOC "Compiler from GLSL to SPIR-V")

function(ao_add_shaders)
    cmake_parse_arguments(arg "" "TARGET;NAMESPACE;API;SUFFIX" "SOURCES;INCLUDE_DIRS;DEFINES" ${ARGN})
    if(NOT AO_GLSLANG)
        message(FATAL_ERROR "glslangValidator not found: install glslang-tools")
    endif()
    if(arg_API STREQUAL "vulkan")
        set(api_flags -V --target-env vulkan1.1)
    elseif(arg_API STREQUAL "opengl")
        set(api_flags -G)
    else()
        message(FATAL_ERROR "ao_add_shaders: API is vulkan or opengl, not '${arg_API}'")
    endif()

    set(dir "${CMAKE_CURRENT_BINARY_DIR}/shaders/${arg_TARGET}")
    file(MAKE_DIRECTORY "${dir}")
    set(include_dirs "${PROJECT_SOURCE_DIR}/include" "${CMAKE_CURRENT_SOURCE_DIR}")
    foreach(include_dir IN LISTS arg_INCLUDE_DIRS)
        cmake_path(ABSOLUTE_PATH include_dir NORMALIZE)
        list(APPEND include_dirs "${include_dir}")
    endforeach()
    list(TRANSFORM include_dirs PREPEND "-I" OUTPUT_VARIABLE include_flags)
    list(TRANSFORM arg_DEFINES PREPEND "-D" OUTPUT_VARIABLE define_flags)

    foreach(source IN LISTS arg_SOURCES)
        cmake_path(ABSOLUTE_PATH source NORMALIZE)
        cmake_path(GET source FILENAME name)
        string(MAKE_C_IDENTIFIER "${name}" name)
        string(APPEND name "${arg_SUFFIX}")
        set(spirv "${dir}/${name}.spv")
        set(cpp "${dir}/${name}.cpp")
        add_custom_command(
            OUTPUT "${spirv}"
            COMMAND "${AO_GLSLANG}" ${api_flags} --quiet ${include_flags} ${define_flags}
                    --depfile "${spirv}.d" -o "${spirv}" "${source}"
            DEPENDS "${source}"
            DEPFILE "${spirv}.d"
            COMMENT "Compiling ${name} for ${arg_API}"
            VERBATIM)
        add_custom_command(
            OUTPUT "${cpp}"
            COMMAND "${CMAKE_COMMAND}" "-DSPIRV=${spirv}" "-DSOURCE=${source}" "-DCPP=${cpp}" "-DNAME=${name}"
                    "-DNAMESPACE=${arg_NAMESPACE}" "-DAPI=${arg_API}" "-DINCLUDE_DIRS=${include_dirs}"
                    "-DDEFINES=${arg_DEFINES}" -P "${AO_SHADER_SCRIPTS}/embed_shader.cmake"
            DEPENDS "${spirv}" "${AO_SHADER_SCRIPTS}/embed_shader.cmake" "${AO_SHADER_SCRIPTS}/flatten_glsl.cmake"
            COMMENT "Embedding ${name}"
            VERBATIM)
        target_sources(${arg_TARGET} PRIVATE "${cpp}")
        set(declaration "namespace ${arg_NAMESPACE}\n{\nextern const std::span<const std::uint32_t> ${name};\n")
        if(arg_API STREQUAL "opengl")
            string(APPEND declaration "extern const std::string_view ${name}_text;\n")
        endif()
        set_property(TARGET ${arg_TARGET} APPEND_STRING PROPERTY AO_SHADER_DECLARATIONS "${declaration}}\n")
        set_property(GLOBAL APPEND PROPERTY AO_SPIRV_FILES "${spirv}")
    endforeach()

    get_target_property(has_header ${arg_TARGET} AO_SHADER_HEADER)
    if(NOT has_header)
        set_target_properties(${arg_TARGET} PROPERTIES AO_SHADER_HEADER "${dir}/${arg_TARGET}_shaders.hpp")
        target_include_directories(${arg_TARGET} PRIVATE "${dir}")
        cmake_language(EVAL CODE "cmake_language(DEFER CALL _ao_write_shader_header \"${arg_TARGET}\")")
    endif()
endfunction()

# Once the calling directory is read, when every ao_add_shaders for the target has been seen.
function(_ao_write_shader_header target)
    get_target_property(header ${target} AO_SHADER_HEADER)
    get_property(declarations TARGET ${target} PROPERTY AO_SHADER_DECLARATIONS)
    file(CONFIGURE OUTPUT "${header}" @ONLY CONTENT
"#pragma once
#include <cstdint>
#include <span>
#include <string_view>

@declarations@")
endfunction()
