#include "host/gl_context.hpp"

#include <dlfcn.h>

#include <GL/osmesa.h>

#include <vector>

namespace ao::host {
namespace {
struct osmesa_library {
    decltype(&OSMesaCreateContextAttribs) create = nullptr;
    decltype(&OSMesaDestroyContext) destroy = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaGetCurrentContext) current = nullptr;
    decltype(&OSMesaGetProcAddress) proc_address = nullptr;
    bool complete() const { return create && destroy && make_current && current && proc_address; }
};

// Never unloaded: Mesa registers handlers for the end of the process.
const osmesa_library& osmesa()
{
    static const osmesa_library library = [] {
        osmesa_library out;
        void* handle = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
        if (!handle)
            handle = dlopen("libOSMesa.so", RTLD_NOW | RTLD_LOCAL);
        if (!handle)
            return out;
        const auto load = [&]<class F>(F& function, const char* name) { function = reinterpret_cast<F>(dlsym(handle, name)); };
        load(out.create, "OSMesaCreateContextAttribs");
        load(out.destroy, "OSMesaDestroyContext");
        load(out.make_current, "OSMesaMakeCurrent");
        load(out.current, "OSMesaGetCurrentContext");
        load(out.proc_address, "OSMesaGetProcAddress");
        return out;
    }();
    return library;
}

class osmesa_context final : public gl_context {
public:
    osmesa_context() : surface_(4 * side * side) {}
    ~osmesa_context() override
    {
        if (context_)
            osmesa().destroy(context_);
    }

    result<done> initialise()
    {
        const int attributes[] = { OSMESA_FORMAT,
                                   OSMESA_RGBA,
                                   OSMESA_PROFILE,
                                   OSMESA_CORE_PROFILE,
                                   OSMESA_CONTEXT_MAJOR_VERSION,
                                   4,
                                   OSMESA_CONTEXT_MINOR_VERSION,
                                   5,
                                   0 };
        context_ = osmesa().create(attributes, nullptr);
        if (!context_)
            return failure{ "no GL context: OSMesa offers no OpenGL 4.5 core profile" };
        if (auto current = make_current(); !current)
            return current;
        return describe();
    }

    result<done> make_current() override
    {
        if (!osmesa().make_current(context_, surface_.data(), GL_UNSIGNED_BYTE, side, side))
            return failure{ "no GL context: OSMesaMakeCurrent failed" };
        return done{};
    }

    gl_loader loader() const override { return osmesa().proc_address; }

private:
    // The default framebuffer, which nobody draws to but OSMesa insists on.
    static constexpr int side = 4;
    std::vector<unsigned char> surface_;
    OSMesaContext context_ = nullptr;
};
}

result<std::unique_ptr<gl_context>> create_osmesa_context(const std::string& device)
{
    if (!osmesa().complete())
        return failure{ "no GL context: libOSMesa.so.8 was not found (install libosmesa6)" };
    auto context = std::make_unique<osmesa_context>();
    if (auto ready = context->initialise(); !ready)
        return failure{ ready.reason() };
    if (!contains_ignoring_case(context->renderer, device))
        return failure{ "no GL device named \"" + device + "\"; OSMesa has \"" + context->renderer + "\"" };
    return std::unique_ptr<gl_context>(std::move(context));
}
}
