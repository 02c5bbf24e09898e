#include "ao/cpu/backend.hpp"
#include "ao/run_frames.hpp"

namespace ao::tools {

run_outcome run_cpu(const run_inputs& in, int lanes)
{
    cpu::options options;
    options.lanes = lanes == 1    ? cpu::width::scalar
                    : lanes == 4  ? cpu::width::lanes4
                    : lanes == 8  ? cpu::width::lanes8
                    : lanes == 16 ? cpu::width::lanes16
                                  : cpu::width::automatic;
    auto backend = take("cpu", cpu::backend::create(options));

    run_outcome out;
    out.label = out.backend = "cpu";
    out.device = std::to_string(backend.threads()) + (backend.threads() == 1 ? " thread" : " threads");
    out.route = cpu::name_of(backend.lanes());

    const stopwatch since;
    auto effect = take("cpu", ao::effect<cpu::backend>::create(backend, in.settings, in.facts, in.camera));
    picture visibility(in.facts.output_format, in.facts.width, in.facts.height);
    auto bound = take("cpu", effect.bind({ cpu::view_of(in.depth), cpu::view_of(in.normal), cpu::view_of(visibility) }));
    time_frames(out, effect.current_plan(), in.frames, since,
                [&] { return draw_pass_by_pass(effect, cpu::commands{}, bound, [] {}); });
    out.visibility = floats_of(visibility);
    return out;
}

} // namespace ao::tools
