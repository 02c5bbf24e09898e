#include "ao/chart_results.hpp"
#include "ao/outcome.hpp"
#include "host/runner.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

namespace ao::tools {
namespace {

double processor_ms()
{
    std::timespec t{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

ao::settings with_radius(ao::settings s, float radius)
{
    s.radius = radius;
    return s;
}

// The cpu's pictures of all configurations in one view.
class picture_maker {
public:
    explicit picture_maker(const chart_view& v) : view_(v), runner_(std::move(take("cpu", host::make_runners("cpu")).front())) {}

    const chart_pictures& inputs(const ao::facts& f)
    {
        const auto key = std::tuple(f.depth, f.depth_format, f.normals, f.normal_format, f.output_format);
        const auto found = inputs_.find(key);
        if (found != inputs_.end())
            return found->second;
        return inputs_.emplace(key, pictures_of(view_.surfaces, view_.effect.projection, f)).first->second;
    }
    ao::picture draw(const ao::settings& s, const ao::facts& f)
    {
        const chart_pictures& in = inputs(f);
        ao::picture drawn =
            take("cpu", runner_->run(with_radius(s, view_.place.radius), in.facts, view_.effect, in.depth, in.normal));
        stop_if_interrupted();
        return drawn;
    }
    // What a method converges to, twice, in full precision.
    const std::pair<std::vector<float>, std::vector<float>>& limits(ao::settings s)
    {
        s = limit_of(s);
        const auto [at, fresh] = limits_.try_emplace({ s.method, s.thickness });
        if (fresh) {
            at->second.first = values_of(draw(s, {}));
            ++s.seed;
            at->second.second = values_of(draw(s, {}));
        }
        return at->second;
    }

private:
    const chart_view& view_;
    host::runner_ptr runner_;
    std::map<std::tuple<depth_source, pixel_format, normal_source, pixel_format, pixel_format>, chart_pictures> inputs_;
    std::map<std::pair<ao::method, float>, std::pair<std::vector<float>, std::vector<float>>> limits_;
};

view_error error_of(const chart_view& v, const std::vector<float>& x, const std::vector<float>& y,
                    const std::pair<std::vector<float>, std::vector<float>>& limits)
{
    view_error e;
    const class_sums against_truth = compare({ x, y }, { v.truth.a, v.truth.b }, v.classes);
    e.truth = of_surfaces(against_truth).result();
    e.sampling = of_surfaces(compare({ x, y }, { limits.first, limits.second }, v.classes)).result();
    for (std::size_t i = 0; i < against_truth.size(); ++i)
        e.classes[i] = against_truth[i].result();
    e.p99 = error_against(x, v.truth.a, v.truth.b, v.surfaces.hit).p99;
    std::size_t over = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (v.surfaces.hit[i] != 0 && std::abs(x[i] - (v.truth.a[i] + v.truth.b[i]) / 2.0f) > 0.1f)
            ++over;
    e.over_tenth = e.truth.pixels == 0 ? 0.0 : static_cast<double>(over) / static_cast<double>(e.truth.pixels);
    return e;
}

// A configuration made ready on a backend and route: it stays so through all views.
struct contestant {
    std::size_t configuration = 0;
    std::size_t time = 0; // index into single_result::times
    host::runner_ptr runner;
    float radius = 0.0f; // prepared for it; 0: not prepared
};

std::vector<std::pair<std::string, std::string>> routes_of(const std::string& backend)
{
    if (backend == "gl")
        return { { "gl compute", "compute" }, { "gl fragment", "fragment" } };
    return { { backend, "" } };
}

std::vector<contestant> make_contestants(chart_results& r)
{
    std::vector<contestant> all;
    for (const std::string& backend : r.options.backends)
        for (const auto& [name, route] : routes_of(backend)) {
            bool known = false;
            for (std::size_t i = 0; i < r.single.size(); ++i) {
                if (!r.single[i].configuration.timed)
                    continue;
                contestant c;
                c.configuration = i;
                c.runner = std::move(take(backend, host::make_runners(backend, r.options.device, route)).front());
                if (!known)
                    r.routes.push_back({ name, c.runner->device(), std::string(c.runner->route()) });
                known = true;
                c.time = r.single[i].times.size();
                r.single[i].times.emplace_back();
                r.single[i].times.back().route = r.routes.size() - 1;
                all.push_back(std::move(c));
                stop_if_interrupted();
            }
        }
    return all;
}

double frame_ms(host::runner& r, const std::string& where)
{
    double ms = 0.0;
    for (const host::pass_time& p : take(where, r.frame()))
        ms += p.ms;
    return ms;
}

void enter(contestant& c, chart_results& r, const chart_view& v, const chart_pictures& in, const ao::picture& expected)
{
    single_result& result = r.single[c.configuration];
    route_time& time = result.times[c.time];
    const std::string where = r.routes[time.route].name + ", " + result.configuration.name;
    const bool first = c.radius == 0.0f;
    if (c.radius != v.place.radius)
        (void)take(where, c.runner->prepare(with_radius(result.configuration.settings, v.place.radius), in.facts, v.effect));
    else
        (void)take(where, c.runner->set_camera(v.effect));
    c.radius = v.place.radius;
    (void)take(where, c.runner->upload(in.depth, in.normal));
    (void)frame_ms(*c.runner, where); // untimed
    if (first)
        time.first_frame_ms = c.runner->first_frame_ms();
    const agreement same = agreement_of(values_of(expected), values_of(take(where, c.runner->download())));
    time.same.pixels += same.pixels;
    time.same.differing += same.differing;
    time.same.largest = std::max(time.same.largest, same.largest);
    if (c.runner->exact() && same.differing > 0)
        throw error(where + ": " + std::to_string(same.differing) + " pixels of '" + v.place.name + "' are not the cpu's");
    stop_if_interrupted();
}

// Round by round in random order, so that what else the machine does falls on all alike.
void time_view(std::vector<contestant>& field, chart_results& r, const chart_view& v, picture_maker& maker,
               const std::vector<ao::picture>& expected, std::size_t view)
{
    progress_line progress("times of " + v.place.name, r.options.progress);
    const double steps = static_cast<double>(field.size()) * (r.options.rounds + 2);
    double done = 0.0;
    for (contestant& c : field) {
        enter(c, r, v, maker.inputs(r.single[c.configuration].configuration.facts), expected[c.configuration]);
        progress.update((done += 2) / steps);
    }
    const double megapixels = r.options.size.width * r.options.size.height * 1e-6;
    std::mt19937 engine(static_cast<unsigned>(view) + 1);
    std::vector<std::size_t> order(field.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    for (int round = 0; round < r.options.rounds; ++round) {
        std::shuffle(order.begin(), order.end(), engine);
        for (const std::size_t i : order) {
            contestant& c = field[i];
            route_time& time = r.single[c.configuration].times[c.time];
            const double before = processor_ms();
            const double ms = frame_ms(*c.runner, r.routes[time.route].name);
            time.processor_ms.push_back((processor_ms() - before) / megapixels);
            time.ms.push_back(ms / megapixels);
            progress.update((done += 1) / steps);
            stop_if_interrupted();
        }
    }
}

} // namespace

void chart_single_frames(chart_results& r)
{
    const chart_options& o = r.options;
    for (chart_configuration& c : single_configurations(o)) {
        single_result next;
        c.facts.width = o.size.width;
        c.facts.height = o.size.height;
        tools::frustum any;
        ao::camera camera;
        camera.projection = projection_of(any);
        const auto plan = make_plan(c.settings, c.facts, camera);
        if (!plan)
            throw error(c.name + ": " + std::string(plan.error().reason()));
        next.cost = cost_of(*plan);
        next.configuration = std::move(c);
        r.single.push_back(std::move(next));
    }
    if (r.single.empty())
        return;
    std::vector<contestant> field = make_contestants(r);
    std::optional<chart_model> model;
    for (const chart_place& place : places_of(o)) {
        if (!model || model->path != place.model)
            model.emplace(place.model);
        const chart_view v = look_from(place, *model, o);
        r.views.push_back({ place, v.camera, model->scene.triangles.size(), count_classes(v.classes),
                            error_of_best_constant(v.truth.a, v.truth.b, v.surfaces.hit).rmse });
        picture_maker maker(v);
        std::vector<ao::picture> pictures(r.single.size());
        progress_line progress("errors in " + place.name, o.progress);
        for (std::size_t i = 0; i < r.single.size(); ++i) {
            const chart_configuration& c = r.single[i].configuration;
            pictures[i] = maker.draw(c.settings, c.facts);
            ao::settings other = c.settings;
            ++other.seed;
            r.single[i].errors.push_back(
                error_of(v, values_of(pictures[i]), values_of(maker.draw(other, c.facts)), maker.limits(c.settings)));
            progress.update(static_cast<double>(i + 1) / static_cast<double>(r.single.size()));
            if (!c.timed)
                pictures[i] = {};
        }
        time_view(field, r, v, maker, pictures, r.views.size() - 1);
    }
}

} // namespace ao::tools
