#include "micro/plain_pass.hpp"

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES 1
#endif
#include <GL/glcorearb.h>

#include <array>
#include <chrono>
#include <string>

namespace ao::bench {

namespace {

constexpr const char* vertex_text = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) uniform mat4 view;
layout(location = 1) uniform mat4 projection;
out vec3 seen_position;
out vec3 seen_normal;
void main()
{
    vec4 seen = view * vec4(position, 1.0);
    seen_position = seen.xyz;
    seen_normal = mat3(view) * normal;
    gl_Position = projection * seen;
}
)";
constexpr const char* fragment_text = R"(#version 450 core
in vec3 seen_position;
in vec3 seen_normal;
layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
void main()
{
    out_position = vec4(seen_position, 1.0);
    out_normal = vec4(normalize(seen_normal), 0.0);
}
)";

#define AO_ENTRY(name) const auto name = reinterpret_cast<decltype(&gl##name)>(context.loader()("gl" #name))

host::result<GLuint> link(const host::gl_context& context)
{
    AO_ENTRY(CreateShader);
    AO_ENTRY(ShaderSource);
    AO_ENTRY(CompileShader);
    AO_ENTRY(CreateProgram);
    AO_ENTRY(AttachShader);
    AO_ENTRY(LinkProgram);
    AO_ENTRY(DeleteShader);
    AO_ENTRY(GetProgramiv);
    const GLuint program = CreateProgram();
    for (const auto& [type, text] : { std::pair(GL_VERTEX_SHADER, vertex_text), std::pair(GL_FRAGMENT_SHADER, fragment_text) }) {
        const GLuint shader = CreateShader(static_cast<GLenum>(type));
        ShaderSource(shader, 1, &text, nullptr);
        CompileShader(shader);
        AttachShader(program, shader);
        DeleteShader(shader);
    }
    LinkProgram(program);
    GLint linked = 0;
    GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) {
        return host::failure{ "the plain pass does not link" };
    }
    return program;
}

} // namespace

host::result<std::unique_ptr<plain_pass>> plain_pass::create(const triangles& t, int width, int height)
{
    auto made = host::gl_context::create();
    if (!made) {
        return host::failure{ made.reason() };
    }
    const host::gl_context& context = **made;
    std::unique_ptr<plain_pass> pass(new plain_pass);
    pass->width_ = width;
    pass->height_ = height;
    pass->indices_ = static_cast<int>(3 * t.indices.size());
    const auto program = link(context);
    if (!program) {
        return host::failure{ program.reason() };
    }
    pass->program_ = *program;

    const host::extent size{ static_cast<unsigned>(width), static_cast<unsigned>(height) };
    const auto add = [&](std::unique_ptr<host::gl_texture>& to, pixel_format format) {
        auto texture = host::gl_texture::create(context, format, size);
        to = texture ? std::make_unique<host::gl_texture>(std::move(*texture)) : nullptr;
        return to != nullptr;
    };
    if (!add(pass->position_, pixel_format::rgba32f) || !add(pass->normal_, pixel_format::rgba16f) ||
        !add(pass->depth_, pixel_format::d32f)) {
        return host::failure{ "no textures for the plain pass" };
    }
    AO_ENTRY(CreateFramebuffers);
    AO_ENTRY(NamedFramebufferTexture);
    AO_ENTRY(NamedFramebufferDrawBuffers);
    AO_ENTRY(CreateBuffers);
    AO_ENTRY(NamedBufferStorage);
    AO_ENTRY(CreateVertexArrays);
    AO_ENTRY(VertexArrayVertexBuffer);
    AO_ENTRY(VertexArrayElementBuffer);
    AO_ENTRY(EnableVertexArrayAttrib);
    AO_ENTRY(VertexArrayAttribFormat);
    AO_ENTRY(VertexArrayAttribBinding);
    CreateFramebuffers(1, &pass->framebuffer_);
    NamedFramebufferTexture(pass->framebuffer_, GL_COLOR_ATTACHMENT0, pass->position_->name, 0);
    NamedFramebufferTexture(pass->framebuffer_, GL_COLOR_ATTACHMENT1, pass->normal_->name, 0);
    NamedFramebufferTexture(pass->framebuffer_, GL_DEPTH_ATTACHMENT, pass->depth_->name, 0);
    constexpr std::array<GLenum, 2> outputs{ GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
    NamedFramebufferDrawBuffers(pass->framebuffer_, 2, outputs.data());

    // They live as long as the context.
    std::array<GLuint, 3> buffers{};
    CreateBuffers(3, buffers.data());
    const auto fill = [&](GLuint buffer, auto values) {
        NamedBufferStorage(buffer, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), 0);
    };
    fill(buffers[0], t.positions);
    fill(buffers[1], t.normals);
    fill(buffers[2], t.indices);
    CreateVertexArrays(1, &pass->vertex_array_);
    for (GLuint i = 0; i < 2; ++i) {
        VertexArrayVertexBuffer(pass->vertex_array_, i, buffers[i], 0, sizeof(glm::vec3));
        EnableVertexArrayAttrib(pass->vertex_array_, i);
        VertexArrayAttribFormat(pass->vertex_array_, i, 3, GL_FLOAT, GL_FALSE, 0);
        VertexArrayAttribBinding(pass->vertex_array_, i, i);
    }
    VertexArrayElementBuffer(pass->vertex_array_, buffers[2]);
    pass->context_ = std::move(*made);
    return pass;
}

host::result<picture> plain_pass::position()
{
    static_cast<void>(context_->make_current());
    picture to(pixel_format::rgba32f, width_, height_);
    if (const auto done = position_->download(to.bytes); !done) {
        return host::failure{ done.reason() };
    }
    return to;
}

double plain_pass::run(const glm::mat4& view, const glm::mat4& projection)
{
    static_cast<void>(context_->make_current());
    const host::gl_context& context = *context_;
    AO_ENTRY(Finish);
    AO_ENTRY(BindFramebuffer);
    AO_ENTRY(Viewport);
    AO_ENTRY(Enable);
    AO_ENTRY(UseProgram);
    AO_ENTRY(BindVertexArray);
    AO_ENTRY(UniformMatrix4fv);
    AO_ENTRY(ClearBufferfv);
    AO_ENTRY(DrawElements);
    constexpr std::array<float, 4> nothing{};
    constexpr float far_end = 1;
    Finish();
    const auto start = std::chrono::steady_clock::now();
    BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
    Viewport(0, 0, width_, height_);
    Enable(GL_DEPTH_TEST);
    UseProgram(program_);
    BindVertexArray(vertex_array_);
    UniformMatrix4fv(0, 1, GL_FALSE, &view[0][0]);
    UniformMatrix4fv(1, 1, GL_FALSE, &projection[0][0]);
    ClearBufferfv(GL_COLOR, 0, nothing.data());
    ClearBufferfv(GL_COLOR, 1, nothing.data());
    ClearBufferfv(GL_DEPTH, 0, &far_end);
    DrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
    Finish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace ao::bench
