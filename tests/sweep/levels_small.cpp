// What levels.cpp does at full length, in a size for every day.
#include "conformance/runners.hpp"
#include "sweep/level_views.hpp"

#include "scene/load.hpp"

TEST_CASE("all backends agree on a view of each level")
{
    const std::vector<ao::host::runner_ptr> owned = usual_runners();
    std::vector<ao::host::runner*> runners;
    for (const ao::host::runner_ptr& r : owned)
        runners.push_back(r.get());
    for (const level& l : levels()) {
        const ao::tools::scene s = ao::tools::load_model(l.model.string());
        const ao::tools::ray_tree tree(s);
        const level_view& view = l.views.front();
        INFO(view.name);
        const level_inputs in = inputs_of(s, tree, view, 320, 180);
        ao::settings settings;
        settings.taps = 8;
        settings.radius = view.radius;
        for (const ao::method method : all_methods) {
            settings.method = method;
            agreed_picture(runners, settings, in);
        }
    }
}
