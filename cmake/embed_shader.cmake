# Script: turns a SPIR-V file, and for OpenGL its source, into a C++ source that holds them as constants.
include("${CMAKE_CURRENT_LIST_DIR}/flatten_glsl.cmake")

file(READ "${SPIRV}" words HEX)
if(NOT words MATCHES "^03022307")
    message(FATAL_ERROR "${SPIRV} is not SPIR-V in little-endian order")
endif()
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${words}")
string(REGEX REPLACE "(0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,)"
       "\\1\n" words "${words}")
set(text_definition "")
if(API STREQUAL "opengl")
    ao_flatten_glsl(text "${SOURCE}" "${INCLUDE_DIRS}" "${DEFINES}")
    file(WRITE "${SPIRV}.glsl" "${text}")
    # Compilers limit the length of one literal (MSVC 16 KiB, ISO C++ 64 KiB), not that of adjacent ones joined.
    set(literals "")
    string(LENGTH "${text}" length)
    set(at 0)
    while(at LESS length)
        string(SUBSTRING "${text}" ${at} 8000 piece)
        string(APPEND literals "R\"glsl(${piece})glsl\"\n")
        math(EXPR at "${at} + 8000")
    endwhile()
    set(text_definition "extern const std::string_view ${NAME}_text;
constinit const std::string_view ${NAME}_text = ${literals};\n")
endif()

file(WRITE "${CPP}" "#include <cstdint>
#include <span>
#include <string_view>

namespace ${NAMESPACE}
{
static constexpr std::uint32_t ${NAME}_words[] = {
${words}};
extern const std::span<const std::uint32_t> ${NAME};
constinit const std::span<const std::uint32_t> ${NAME}{ ${NAME}_words };
${text_definition}}
")
