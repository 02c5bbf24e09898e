#include "ao/bake_options.hpp"
#include "ao/bake_program.hpp"
#include "ao/chart_program.hpp"
#include "ao/explain.hpp"
#include "ao/facts.hpp"
#include "ao/options.hpp"
#include "ao/render.hpp"
#include "ao/temporal_render.hpp"
#include "scene/error.hpp"
#include "scene/signals.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <new>

namespace {

int fail(const std::string& reason)
{
    std::fprintf(stderr, "ao: %s\n", ao::tools::one_line(reason).c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv)
try {
    CLI::App app("Ambient occlusion of a scene, on CPU, OpenGL and Vulkan");
    app.require_subcommand(1);
    ao::tools::render_arguments arguments;
    CLI::App& render = *app.add_subcommand("render", "Render a scene's ambient occlusion and compare the backends");
    ao::tools::add_render_options(render, arguments);
    bool explain = false;
    render.add_flag("--explain", explain, "print the plan's passes, what it leaves out and why, and render nothing");
    CLI::App& facts = *app.add_subcommand("facts", "Print what a plan may rely on about a scene; takes the options of render");
    ao::tools::add_render_options(facts, arguments);
    ao::tools::bake_arguments bake_arguments;
    CLI::App& bake = *app.add_subcommand("bake", "Bake a model's ambient occlusion per vertex");
    ao::tools::add_bake_options(bake, bake_arguments);
    ao::tools::chart_arguments chart_arguments;
    CLI::App& chart = *app.add_subcommand("chart", "Chart error against time: all methods, all backends");
    ao::tools::add_chart_options(chart, chart_arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return e.get_exit_code() == 0 ? app.exit(e) : fail(e.what());
    }
    if (bake.parsed()) {
        ao::tools::note_given(bake, bake_arguments);
        ao::tools::catch_interrupts();
        return ao::tools::bake(ao::tools::check_arguments(bake_arguments)) ? 0 : 1;
    }
    if (chart.parsed()) {
        ao::tools::catch_interrupts();
        ao::tools::chart(ao::tools::check_arguments(chart_arguments));
        return 0;
    }
    const CLI::App& seen = facts.parsed() ? facts : render;
    arguments.has_yaw = seen.count("--yaw") > 0;
    arguments.has_pitch = seen.count("--pitch") > 0;
    arguments.has_fov = seen.count("--fov") > 0;
    arguments.has_frames = seen.count("--frames") > 0;
    ao::tools::catch_interrupts();
    const ao::tools::render_options options = ao::tools::check_arguments(arguments);
    if (facts.parsed()) {
        ao::tools::print_facts(options);
        return 0;
    }
    if (explain) {
        std::fputs(ao::tools::explain(options).c_str(), stdout);
        return 0;
    }
    options.temporal ? ao::tools::render_temporal(options) : ao::tools::render(options);
    return 0;
} catch (const std::bad_alloc&) {
    return fail("out of memory");
} catch (const std::exception& e) {
    return fail(e.what());
}
