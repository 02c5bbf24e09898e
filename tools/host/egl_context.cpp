#include "host/gl_context.hpp"

#include <dlfcn.h>

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <vector>

namespace ao::host {
namespace {
struct egl_library {
    decltype(&eglGetProcAddress) proc_address = nullptr;
    decltype(&eglInitialize) initialise = nullptr;
    decltype(&eglTerminate) terminate = nullptr;
    decltype(&eglBindAPI) bind_api = nullptr;
    decltype(&eglCreateContext) create_context = nullptr;
    decltype(&eglDestroyContext) destroy_context = nullptr;
    decltype(&eglMakeCurrent) make_current = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display = nullptr;
    bool complete() const
    {
        return proc_address && initialise && terminate && bind_api && create_context && destroy_context && make_current &&
               platform_display;
    }
};

const egl_library& egl()
{
    static const egl_library library = [] {
        egl_library out;
        void* handle = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
        if (!handle)
            return out;
        const auto load = [&]<class F>(F& function, const char* name) { function = reinterpret_cast<F>(dlsym(handle, name)); };
        load(out.proc_address, "eglGetProcAddress");
        load(out.initialise, "eglInitialize");
        load(out.terminate, "eglTerminate");
        load(out.bind_api, "eglBindAPI");
        load(out.create_context, "eglCreateContext");
        load(out.destroy_context, "eglDestroyContext");
        load(out.make_current, "eglMakeCurrent");
        if (out.proc_address) {
            out.query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(out.proc_address("eglQueryDevicesEXT"));
            out.platform_display =
                reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(out.proc_address("eglGetPlatformDisplayEXT"));
        }
        return out;
    }();
    return library;
}

class egl_context final : public gl_context {
public:
    explicit egl_context(EGLDisplay display) : display_(display) {}
    ~egl_context() override
    {
        if (context_ != EGL_NO_CONTEXT) {
            egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            egl().destroy_context(display_, context_);
        }
        // The display stays initialised: EGL hands out one per device and process, other contexts may use it.
    }

    result<done> initialise()
    {
        if (!egl().initialise(display_, nullptr, nullptr) || !egl().bind_api(EGL_OPENGL_API))
            return failure{ "no GL context: eglInitialize failed" };
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE
        };
        context_ = egl().create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT)
            return failure{ "no GL context: EGL offers no OpenGL 4.5 core profile" };
        if (auto current = make_current(); !current)
            return current;
        return describe();
    }

    result<done> make_current() override
    {
        if (!egl().bind_api(EGL_OPENGL_API) || !egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            return failure{ "no GL context: eglMakeCurrent without a surface failed" };
        return done{};
    }

    gl_loader loader() const override { return egl().proc_address; }

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

std::vector<EGLDisplay> displays()
{
    std::vector<EGLDisplay> out;
    const auto add = [&](EGLenum platform, void* native) {
        const EGLDisplay display = egl().platform_display(platform, native, nullptr);
        if (display != EGL_NO_DISPLAY)
            out.push_back(display);
    };
    EGLint count = 0;
    if (egl().query_devices && egl().query_devices(0, nullptr, &count) && count > 0) {
        std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
        egl().query_devices(count, devices.data(), &count);
        devices.resize(static_cast<std::size_t>(count));
        for (const EGLDeviceEXT device : devices)
            add(EGL_PLATFORM_DEVICE_EXT, device);
    }
    add(EGL_PLATFORM_SURFACELESS_MESA, nullptr);
    return out;
}
}

result<std::unique_ptr<gl_context>> create_egl_context(const std::string& device)
{
    if (!egl().complete())
        return failure{ "no GL context: libEGL.so.1 was not found or is too old (install libegl1)" };
    std::string reason = "no GL context: EGL has no device";
    std::string seen;
    for (const EGLDisplay display : displays()) {
        auto context = std::make_unique<egl_context>(display);
        if (auto ready = context->initialise(); !ready) {
            reason = ready.reason();
            continue;
        }
        if (contains_ignoring_case(context->renderer, device))
            return std::unique_ptr<gl_context>(std::move(context));
        seen += (seen.empty() ? "\"" : ", \"") + context->renderer + "\"";
    }
    if (!seen.empty())
        return failure{ "no GL device named \"" + device + "\"; EGL has " + seen };
    return failure{ reason };
}
}
