#pragma once

#include <memory>

namespace ao::gl {

class backend;
struct program_state;
struct binding_state;

// Linked programs, tables and the plan's own pictures. The context must be current when it is destroyed, and the backend alive.
class program {
public:
    program(program&&) noexcept;
    program& operator=(program&&) noexcept;
    ~program();

private:
    friend class backend;
    explicit program(std::unique_ptr<program_state> state);
    std::unique_ptr<program_state> state_;
};

// Views of the host's textures and a framebuffer. The host's textures may be deleted before it: a view keeps the storage.
// The context must be current when it is destroyed, and the backend alive.
class binding {
public:
    binding(binding&&) noexcept;
    binding& operator=(binding&&) noexcept;
    ~binding();

private:
    friend class backend;
    explicit binding(std::unique_ptr<binding_state> state);
    std::unique_ptr<binding_state> state_;
};

} // namespace ao::gl
