#include "host/gl_texture.hpp"
#include "test_host_shaders.hpp"

#include <catch2/catch.hpp>

#include <GL/glcorearb.h>

#include <array>
#include <string>
#include <vector>

using namespace ao;
using namespace ao::host;

namespace {
template <class Function>
Function load(const gl_context& context, const char* name)
{
    return reinterpret_cast<Function>(context.loader()(name));
}

// Red of the two pixels after one dispatch of two groups of one.
std::array<float, 2> run(const gl_context& context, unsigned shader)
{
    const unsigned program = load<PFNGLCREATEPROGRAMPROC>(context, "glCreateProgram")();
    load<PFNGLATTACHSHADERPROC>(context, "glAttachShader")(program, shader);
    load<PFNGLLINKPROGRAMPROC>(context, "glLinkProgram")(program);
    GLint linked = 0;
    load<PFNGLGETPROGRAMIVPROC>(context, "glGetProgramiv")(program, GL_LINK_STATUS, &linked);
    REQUIRE(linked);
    auto texture = gl_texture::create(context, pixel_format::r32f, { 2, 1 });
    REQUIRE(texture);
    load<PFNGLUSEPROGRAMPROC>(context, "glUseProgram")(program);
    load<PFNGLBINDIMAGETEXTUREPROC>(context, "glBindImageTexture")(0, texture->name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    load<PFNGLDISPATCHCOMPUTEPROC>(context, "glDispatchCompute")(2, 1, 1);
    load<PFNGLMEMORYBARRIERPROC>(context, "glMemoryBarrier")(GL_ALL_BARRIER_BITS);
    std::array<float, 2> pixels{};
    REQUIRE(texture->download(std::as_writable_bytes(std::span(pixels))));
    load<PFNGLDELETEPROGRAMPROC>(context, "glDeleteProgram")(program);
    load<PFNGLDELETESHADERPROC>(context, "glDeleteShader")(shader);
    return pixels;
}

unsigned compile(const gl_context& context, const std::string& defines)
{
    const std::string text(planted::flattened_comp_text);
    const std::size_t body = text.find('\n') + 1;
    const std::string whole = text.substr(0, body) + defines + text.substr(body);
    const char* source = whole.c_str();
    const unsigned shader = load<PFNGLCREATESHADERPROC>(context, "glCreateShader")(GL_COMPUTE_SHADER);
    load<PFNGLSHADERSOURCEPROC>(context, "glShaderSource")(shader, 1, &source, nullptr);
    load<PFNGLCOMPILESHADERPROC>(context, "glCompileShader")(shader);
    GLint compiled = 0;
    load<PFNGLGETSHADERIVPROC>(context, "glGetShaderiv")(shader, GL_COMPILE_STATUS, &compiled);
    char log[1000] = "";
    load<PFNGLGETSHADERINFOLOGPROC>(context, "glGetShaderInfoLog")(shader, sizeof log, nullptr, log);
    INFO(log << whole);
    REQUIRE(compiled);
    return shader;
}

unsigned specialise(const gl_context& context, std::vector<unsigned> ids, std::vector<unsigned> values)
{
    const unsigned shader = load<PFNGLCREATESHADERPROC>(context, "glCreateShader")(GL_COMPUTE_SHADER);
    load<PFNGLSHADERBINARYPROC>(context, "glShaderBinary")(1, &shader, 0x9551 /* GL_SHADER_BINARY_FORMAT_SPIR_V */,
                                                           planted::flattened_comp.data(),
                                                           static_cast<GLsizei>(planted::flattened_comp.size_bytes()));
    const auto finish = reinterpret_cast<void(APIENTRYP)(GLuint, const GLchar*, GLuint, const GLuint*, const GLuint*)>(
        context.loader()("glSpecializeShaderARB"));
    REQUIRE(finish);
    finish(shader, "main", static_cast<GLuint>(ids.size()), ids.data(), values.data());
    return shader;
}
}

TEST_CASE("flattened text is plain GLSL")
{
    const std::string text(planted::flattened_comp_text);
    CHECK(text.starts_with("#version 450 core\n"));
    for (const char* refused : { "#include", "#line", "GL_GOOGLE", "constant_id", "local_size_x_id", "//", "/*" })
        CHECK(text.find(refused) == std::string::npos);
    for (const char c : text)
        CHECK(static_cast<unsigned char>(c) < 128);
}

TEST_CASE("flattened text and SPIR-V give the same program, with defaults and with specialised constants")
{
    auto context = gl_context::create();
    REQUIRE(context);
    const std::array<float, 2> defaults = { 32.5f, 33.5f };
    CHECK(run(**context, compile(**context, "#define AO_SPEC_7 1\n")) == defaults);
    CHECK(run(**context, specialise(**context, { 7 }, { 1 })) == defaults);
    const std::array<float, 2> specialised = { 11.0f, 12.0f };
    CHECK(run(**context, compile(**context, "#define AO_SPEC_7 1\n#define AO_SPEC_3 5\n#define AO_SPEC_4 false\n")) ==
          specialised);
    CHECK(run(**context, specialise(**context, { 7, 3, 4 }, { 1, 5, 0 })) == specialised);
}
