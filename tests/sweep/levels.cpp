// Every view of the levels at full size: no backend's picture differs from another's in any bit, and the errors against
// ray-traced truth are what the project promises.
#include "conformance/runners.hpp"
#include "sweep/level_views.hpp"

#include "scene/load.hpp"
#include "scene/metrics.hpp"
#include "scene/truth.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace {

constexpr int width = 1280;
constexpr int height = 720;
constexpr unsigned truth_rays = 64;
// Issue 2: 32 taps, box filter of 5x5, on the view "hall" with the kernel `box`.
constexpr double promised_rmse = 0.08;

struct runner_set {
    std::vector<ao::host::runner_ptr> owned = usual_runners();
    std::vector<ao::host::runner*> all;
    std::vector<ao::host::runner*> fast; // without the scalar reference, where there is another
    runner_set()
    {
        for (const ao::host::runner_ptr& r : owned) {
            all.push_back(r.get());
            if (r->route() != "scalar")
                fast.push_back(r.get());
        }
    }
};

// One view: all kernels, taps and thicknesses. Prints its rows of the table.
void sweep_view(const runner_set& runners, const ao::tools::scene& s, const ao::tools::ray_tree& tree, const level_view& view)
{
    INFO(view.name);
    const level_inputs in = inputs_of(s, tree, view, width, height);
    const auto truth = ao::tools::trace_truth(s, tree, view.camera, in.surfaces, { view.radius, truth_rays, 1 });
    REQUIRE(truth);
    const ao::tools::picture_error constant = ao::tools::error_of_best_constant(truth->a, truth->b, in.surfaces.hit);
    ao::settings settings;
    settings.radius = view.radius;
    settings.filter = 5;
    for (const ao::method method : all_methods) {
        settings.method = method;
        std::printf("%-8s %-10s", view.name.c_str(), name_of(method));
        for (const float thickness : { ao::settings{}.thickness, std::numeric_limits<float>::infinity() }) {
            settings.thickness = thickness;
            for (const int taps : { 8, 32, 128 }) {
                settings.taps = taps;
                const std::vector<float> picture = agreed_picture(taps == 8 ? runners.all : runners.fast, settings, in);
                if (taps != 32)
                    continue;
                const auto e = ao::tools::error_against(picture, truth->a, truth->b, in.surfaces.hit);
                std::printf(" %8.4f %+8.4f", e.rmse, e.bias);
                if (view.name == "hall" && method == ao::method::box)
                    CHECK(e.rmse <= promised_rmse);
                // With infinite thickness silhouettes darken what lies far behind them: on an open view like "rocks" more
                // than there is to see. That is why there is a limit, and what it is for is checked here.
                if (thickness == ao::settings{}.thickness)
                    CHECK(e.rmse < constant.rmse);
            }
        }
        std::printf(" %8.4f\n", constant.rmse);
        std::fflush(stdout);
    }
}

} // namespace

TEST_CASE("all backends agree on every view of the levels, and their errors are as promised")
{
    const runner_set runners;
    const std::vector<level> all = levels();
    std::printf("32 taps, filter 5, %dx%d, truth of %u rays; RMSE and bias\n", width, height, truth_rays);
    std::printf("%-8s %-10s %17s %17s %8s\n", "view", "kernel", "default thickness", "infinite", "constant");
    for (const level& l : all) {
        const ao::tools::scene s = ao::tools::load_model(l.model.string());
        const ao::tools::ray_tree tree(s);
        for (const level_view& view : l.views)
            sweep_view(runners, s, tree, view);
    }
}

TEST_CASE("all backends agree on the presets of bitmask on every view, and their errors are as promised")
{
    const runner_set runners;
    struct promise {
        const char* name;
        ao::preset preset;
        double rmse; // mean of the seven views, issue 6
        double sum = 0;
        double worst = 0;
    };
    promise promises[] = { { "low", ao::preset::low, 0.088 },
                           { "medium", ao::preset::medium, 0.068 },
                           { "high", ao::preset::high, 0.058 },
                           { "ultra", ao::preset::ultra, 0.053 } };
    int views = 0;
    for (const level& l : levels()) {
        const ao::tools::scene s = ao::tools::load_model(l.model.string());
        const ao::tools::ray_tree tree(s);
        for (const level_view& view : l.views) {
            INFO(view.name);
            ++views;
            const level_inputs in = inputs_of(s, tree, view, width, height);
            const auto truth = ao::tools::trace_truth(s, tree, view.camera, in.surfaces, { view.radius, truth_rays, 1 });
            REQUIRE(truth);
            std::printf("%-8s bitmask   ", view.name.c_str());
            for (promise& p : promises) {
                const std::vector<float> picture = agreed_picture(runners.fast, ao::settings_of(p.preset, view.radius), in);
                const auto e = ao::tools::error_against(picture, truth->a, truth->b, in.surfaces.hit);
                p.sum += e.rmse;
                p.worst = std::max(p.worst, e.rmse);
                std::printf(" %s %.4f %+.4f", p.name, e.rmse, e.bias);
            }
            std::printf("\n");
            std::fflush(stdout);
        }
    }
    if (views == 0)
        return; // levels() has said so
    for (const promise& p : promises) {
        INFO(p.name);
        std::printf("bitmask %s: mean %.4f, worst %.4f\n", p.name, p.sum / views, p.worst);
        CHECK(p.sum / views <= p.rmse);
    }
}
