#pragma once
#include "host/result.hpp"

#include <memory>
#include <string>

namespace ao::host {
using gl_proc = void (*)();
using gl_loader = gl_proc (*)(const char* name);

enum class gl_platform {
    osmesa,
    // Surfaceless, for real GPUs.
    egl,
};

struct gl_options {
    gl_platform platform = gl_platform::osmesa;
    // Part of GL_RENDERER, letter case ignored; egl tries its devices in order. Empty: the first that works.
    std::string device;
};

// An OpenGL 4.5 core context without a window. The libraries are loaded when one is asked for, so that a program
// runs without them until then. Its thread may change by make_current there; one thread at a time.
class gl_context {
public:
    // The new context is current on success.
    static result<std::unique_ptr<gl_context>> create(const gl_options& options = {});
    virtual ~gl_context() = default;
    gl_context(const gl_context&) = delete;
    gl_context& operator=(const gl_context&) = delete;

    virtual result<done> make_current() = 0;
    // A plain function, as the gl backend takes it; good while a context of this platform is current.
    virtual gl_loader loader() const = 0;

    std::string vendor;
    std::string renderer;
    std::string version;

protected:
    gl_context() = default;
    // Reads the three strings of the current context; fails below 4.5.
    result<done> describe();
};

result<std::unique_ptr<gl_context>> create_osmesa_context(const std::string& device);
result<std::unique_ptr<gl_context>> create_egl_context(const std::string& device);
bool contains_ignoring_case(const std::string& text, const std::string& part);
}
