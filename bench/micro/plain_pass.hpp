// A position-and-normal pass as one writes it by hand for one scene: one program, one draw, nothing to choose.
#pragma once

#include "ao/picture.hpp"
#include "host/gl_context.hpp"
#include "host/gl_texture.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>

namespace ao::bench {

class plain_pass {
public:
    struct triangles {
        std::span<const glm::vec3> positions; // world space
        std::span<const glm::vec3> normals;
        std::span<const glm::uvec3> indices;
    };
    // In a context of its own.
    static host::result<std::unique_ptr<plain_pass>> create(const triangles& t, int width, int height);

    // Milliseconds. OpenGL's own conventions: the first row at NDC y = -1, depth -1 ... 1.
    double run(const glm::mat4& view, const glm::mat4& projection);
    // rgba32f: view space, w = 1.
    host::result<picture> position();

private:
    plain_pass() = default;

    std::unique_ptr<host::gl_context> context_;
    std::unique_ptr<host::gl_texture> position_;
    std::unique_ptr<host::gl_texture> normal_;
    std::unique_ptr<host::gl_texture> depth_;
    unsigned program_ = 0;
    unsigned vertex_array_ = 0;
    unsigned framebuffer_ = 0;
    int indices_ = 0;
    int width_ = 0;
    int height_ = 0;
};

} // namespace ao::bench
