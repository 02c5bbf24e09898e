#include "ao/gl/bake.hpp"
#include "host/bake_runner_of.hpp"
#include "host/gl_context.hpp"
#include "host/runner.hpp"

#include <memory>

namespace ao::host {

ao::result<bake_runner_ptr> make_gl_bake_runner(const bake_runner_options& o)
{
    auto context = gl_context::create(gl_context_of(o.device));
    if (!context) {
        return error(errc::device, context.reason());
    }
    auto baker = gl::baker::create((*context)->loader(), { .restore_state = false });
    if (!baker) {
        return baker.error();
    }
    std::string name = (*context)->renderer;
    // The context stays current in this thread, which is the one that bakes.
    using made = bake_runner_of<std::unique_ptr<gl_context>, gl::baker>;
    return bake_runner_ptr(std::make_unique<made>("gl", std::move(name), std::move(*context), std::move(*baker)));
}

} // namespace ao::host
