#include "ao/chart_results.hpp"
#include "ao/outcome.hpp"
#include "ao/ray_motion.hpp"
#include "host/runner.hpp"
#include "host/temporal_runner.hpp"
#include "scene/courtyard.hpp"
#include "scene/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>

namespace ao::tools {
namespace {

// Frames at the end that are timed: by then pixels that stand are sampled few at a time, and no longer filtered.
constexpr int timed_frames = 6;

double processor_ms()
{
    std::timespec t{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

ao::temporal_camera effect_of(const tools::camera& seen, const ao::camera_projection& projection)
{
    ao::temporal_camera c;
    c.projection = projection;
    const glm::mat4 view = view_matrix(seen);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            c.world_to_view[column][row] = view[column][row];
    for (int i = 0; i < 3; ++i)
        c.eye[static_cast<std::size_t>(i)] = static_cast<double>(seen.eye[i]);
    return c;
}

// The frames of one animation, one after another.
class animated_view {
public:
    animated_view(const chart_place& place, const chart_model& rest, const std::string& words, const chart_options& o)
        : options_(o),
          model_(rest),
          motion_(choose_motion(words, { rest.scene, camera_of(place, rest, o), rest.path == "courtyard" && words != "static",
                                         o.frames, o.size.height }))
    {
        const bounds b = bounds_of(rest.scene);
        depth_range range = clip_range(b, motion_.camera_at(0));
        for (int f = 1; f < o.frames; ++f) {
            const depth_range each = clip_range(b, motion_.camera_at(f));
            range = { std::min(range.near, each.near), std::max(range.far, each.far) };
        }
        range.near = std::max(range.near, range.far / 1000.0f);
        frustum = frustum_of(motion_.camera_at(0), o, range);
        projection = projection_of(frustum);
    }

    void advance()
    {
        ++frame;
        const tools::camera now = motion_.camera_at(frame);
        const bool moved = motion_.moves_objects();
        if (frame > 0 && !motion_.moves_camera() && !moved) {
            previous = surfaces;
            return;
        }
        std::swap(previous, surfaces);
        if (moved) {
            scene_ = motion_.moved(model_.scene, frame);
            tree_.emplace(*scene_);
        }
        surfaces = trace_gbuffer(seen(), tree(), now, frustum, options_.size.width, options_.size.height);
        if (frame == 0)
            previous = surfaces;
        camera = now;
        stop_if_interrupted();
    }
    [[nodiscard]] bool objects_move() const { return motion_.moves_objects(); }
    [[nodiscard]] ao::picture motion_picture() const
    {
        const auto folded = fold_projection(projection, options_.size.width, options_.size.height);
        return motion_of_rays(surfaces, { camera, *folded }, { motion_.previous_camera(frame), *folded }, motion_, frame);
    }
    [[nodiscard]] const tools::scene& seen() const { return scene_ ? *scene_ : model_.scene; }
    [[nodiscard]] const ray_tree& tree() const { return tree_ ? *tree_ : model_.tree; }

    int frame = -1;
    tools::camera camera;
    tools::frustum frustum;
    ao::camera_projection projection;
    gbuffer surfaces, previous;

private:
    const chart_options& options_;
    const chart_model& model_;
    motion motion_;
    std::optional<tools::scene> scene_; // where objects move
    std::optional<ray_tree> tree_;
};

// What the last frame is held against.
struct last_frame {
    truth_halves truth;
    std::vector<pixel_class> classes;
    std::vector<std::size_t> from; // pixel of the frame before, for those neither background nor disoccluded
};

last_frame look_at_last(const animated_view& a, const chart_place& place, const chart_options& o)
{
    last_frame last;
    const ao::picture moved = a.motion_picture();
    std::vector<pixel_motion> motion(moved.pixels());
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const auto texel = moved.texel<glm::vec4>(i);
        motion[i] = { texel.x, texel.y, texel.z };
    }
    last.classes = classify(a.surfaces, { place.radius, focal_of(a.frustum, o.size.width), false });
    mark_disoccluded(last.classes, a.previous, motion);
    last.from.assign(motion.size(), 0);
    for (std::size_t i = 0; i < motion.size(); ++i) {
        if (last.classes[i] == pixel_class::background || last.classes[i] == pixel_class::disoccluded)
            continue;
        const auto width = static_cast<std::size_t>(o.size.width);
        const auto x = static_cast<std::size_t>(static_cast<float>(i % width) + 0.5f + motion[i].x);
        const auto y = static_cast<std::size_t>(static_cast<float>(i / width) + 0.5f + motion[i].y);
        last.from[i] = y * width + x;
    }
    progress_line progress("truth of the last frame of " + place.name, o.progress);
    auto truth = trace_truth(a.seen(), a.tree(), a.camera, a.surfaces, { place.radius, o.rays, 1 }, &interrupted(),
                             [&](double share) { progress.update(share); });
    stop_if_interrupted();
    last.truth = std::move(*truth);
    return last;
}

// Of surface points that the frame before showed.
std::vector<double> changes(const std::vector<float>& now, const std::vector<float>& before, const last_frame& last)
{
    std::vector<double> all;
    for (std::size_t i = 0; i < now.size(); ++i)
        if (last.classes[i] != pixel_class::background && last.classes[i] != pixel_class::disoccluded)
            all.push_back(std::abs(static_cast<double>(now[i]) - static_cast<double>(before[last.from[i]])));
    return all;
}

struct contestant {
    std::size_t configuration = 0;
    std::optional<std::size_t> still, moving; // where times go
    host::temporal_runner_ptr runner;
    std::vector<float> before;
};

contestant make_contestant(chart_results& r, const std::string& backend, std::size_t configuration, bool timed)
{
    contestant c;
    c.configuration = configuration;
    c.runner = std::move(take(backend, host::make_temporal_runners(backend, r.options.device)).front());
    if (!timed)
        return c;
    const auto known = std::find_if(r.temporal_routes.begin(), r.temporal_routes.end(),
                                    [&](const chart_route& each) { return each.name == backend; });
    const auto route = static_cast<std::size_t>(known - r.temporal_routes.begin());
    if (known == r.temporal_routes.end())
        r.temporal_routes.push_back({ backend, c.runner->device(), std::string(c.runner->route()) });
    chart_temporal& result = r.temporal[configuration];
    for (auto* times : { &result.still_times, &result.moving_times }) {
        times->emplace_back();
        times->back().route = route;
    }
    c.still = c.moving = result.still_times.size() - 1;
    return c;
}

// The cost of a frame of a view that stands, and of one in which the camera moves.
void find_costs(chart_temporal& r, const chart_options& o)
{
    temporal_facts f;
    f.frame.width = o.size.width;
    f.frame.height = o.size.height;
    auto plan = make_temporal_plan(r.configuration.settings, f);
    if (!plan)
        throw error(r.configuration.name + ": " + std::string(plan.error().reason()));
    const ao::camera_projection projection = projection_of(tools::frustum{});
    temporal_state state;
    tools::camera at;
    const int samples = r.configuration.settings.later_samples;
    for (int frame = 0; frame + 1 < frames_to_converge(r.configuration.settings); ++frame)
        (void)next_frame(*plan, state, effect_of(at, projection));
    const temporal_frame still = *next_frame(*plan, state, effect_of(at, projection));
    r.still = cost_of(*plan, { still.steps.begin(), still.steps.end() }, samples);
    at.eye.x = 1.0f;
    const temporal_frame moving = *next_frame(*plan, state, effect_of(at, projection));
    r.moving = cost_of(*plan, { moving.steps.begin(), moving.steps.end() }, samples);
}

// One animation with all configurations.
class motion_run {
public:
    motion_run(chart_results& r, const chart_place& place, std::string words, animated_view& a)
        : r_(r),
          place_(place),
          words_(std::move(words)),
          view_(a)
    {
        facts_.motion = a.objects_move();
        facts_.motion_format = pixel_format::rgba32f;
    }

    void frames(std::vector<contestant>& field)
    {
        const int count = r_.options.frames;
        progress_line progress(words_ + " of " + place_.name, r_.options.progress);
        for (int f = 0; f < count; ++f) {
            view_.advance();
            if (f == 0 || words_ != "static")
                pictures_ = pictures_of(view_.surfaces, view_.projection, {});
            if (facts_.motion)
                motion_ = view_.motion_picture();
            const bool last = f + 1 == count;
            if (f == 0)
                facts_.frame = pictures_.facts;
            if (last || (f == 0 && words_ == "static"))
                last_ = look_at_last(view_, place_, r_.options);
            for (contestant& c : field)
                run(c, f);
            if (f + 2 == count || last)
                single_frames(last);
            progress.update(static_cast<double>(f + 1) / count);
        }
    }

private:
    [[nodiscard]] std::string where(const contestant& c) const
    {
        return std::string(c.runner->backend()) + ", " + r_.temporal[c.configuration].configuration.name;
    }

    void run(contestant& c, int f)
    {
        const int count = r_.options.frames;
        chart_temporal& result = r_.temporal[c.configuration];
        if (f == 0) {
            ao::temporal_settings s = result.configuration.settings;
            s.radius = place_.radius;
            (void)take(where(c), c.runner->prepare(s, facts_));
        }
        (void)take(where(c), c.runner->upload(pictures_.depth, pictures_.normal, motion_));
        const double before = processor_ms();
        double ms = 0.0;
        for (const host::temporal_pass_time& p : take(where(c), c.runner->frame(effect_of(view_.camera, view_.projection))))
            ms += p.ms;
        const double processor = processor_ms() - before;
        const double megapixels = r_.options.size.width * r_.options.size.height * 1e-6;
        if (const auto at = words_ == "static" ? c.still
                            : words_ == "pan"  ? c.moving
                                               : std::nullopt;
            at && f + timed_frames >= count) {
            route_time& time = (words_ == "static" ? result.still_times : result.moving_times)[*at];
            time.ms.push_back(ms / megapixels);
            time.processor_ms.push_back(processor / megapixels);
        }
        stop_if_interrupted();
        const bool last = f + 1 == count;
        if (f + 2 < count && !(f == 0 && words_ == "static"))
            return;
        std::vector<float> seen = values_of(take(where(c), c.runner->download()));
        if (last)
            finish(c, seen);
        if (f == 0)
            first_[c.runner.get()] = error_against(seen, last_.truth.a, last_.truth.b, view_.surfaces.hit).rmse;
        c.before = std::move(seen);
    }

    void finish(contestant& c, const std::vector<float>& seen)
    {
        chart_temporal& result = r_.temporal[c.configuration];
        if (c.runner->backend() == "cpu") {
            motion_error e;
            e.view = place_.name;
            e.motion = words_;
            e.truth = error_against(seen, last_.truth.a, last_.truth.b, view_.surfaces.hit);
            const class_sums sums = compare({ seen, seen }, { last_.truth.a, last_.truth.b }, last_.classes);
            for (std::size_t i = 0; i < sums.size(); ++i)
                e.classes[i] = sums[i].result();
            std::vector<double> changed = changes(seen, c.before, last_);
            e.flicker = changed.empty() ? 0.0 : mean_of(changed);
            e.flicker_p99 = changed.empty() ? 0.0 : percentile_99(std::move(changed));
            const auto first = first_.find(c.runner.get());
            e.first = first == first_.end() ? std::numeric_limits<double>::quiet_NaN() : first->second;
            result.errors.push_back(std::move(e));
            expected_.resize(r_.temporal.size());
            expected_[c.configuration] = seen;
            if (!c.still)
                return;
        }
        if (words_ != "static" && words_ != "pan")
            return;
        const agreement same = agreement_of(expected_[c.configuration], seen);
        route_time& time = (words_ == "static" ? result.still_times : result.moving_times)[*c.still];
        time.same.pixels += same.pixels;
        time.same.differing += same.differing;
        if (c.runner->exact() && same.differing > 0)
            throw error(where(c) + ": " + std::to_string(same.differing) + " pixels of '" + place_.name + "' are not the cpu's");
    }

    // How much the methods without a history change in the pan.
    void single_frames(bool last)
    {
        if (words_ != "pan" || r_.single.empty())
            return;
        if (!single_)
            single_ = std::move(take("cpu", host::make_runners("cpu")).front());
        single_before_.resize(r_.single.size());
        ao::camera camera;
        camera.projection = view_.projection;
        for (std::size_t i = 0; i < r_.single.size(); ++i) {
            single_result& each = r_.single[i];
            const chart_configuration& c = each.configuration;
            constexpr std::array<const char*, 5> shown{ "taps", "presets", "resolution", "filter", "thickness" };
            if (!c.timed || std::find(shown.begin(), shown.end(), c.varies) == shown.end())
                continue;
            ao::settings s = c.settings;
            s.radius = place_.radius;
            std::vector<float> seen =
                values_of(take("cpu", single_->run(s, pictures_.facts, camera, pictures_.depth, pictures_.normal)));
            if (last)
                if (const std::vector<double> changed = changes(seen, single_before_[i], last_); !changed.empty())
                    each.flicker.push_back(mean_of(changed));
            single_before_[i] = std::move(seen);
            stop_if_interrupted();
        }
    }

    chart_results& r_;
    const chart_place& place_;
    std::string words_;
    animated_view& view_;
    temporal_facts facts_;
    chart_pictures pictures_;
    ao::picture motion_;
    last_frame last_;
    std::map<const host::temporal_runner*, double> first_;
    std::vector<std::vector<float>> expected_; // the cpu's, by configuration
    host::runner_ptr single_;
    std::vector<std::vector<float>> single_before_;
};

} // namespace

void chart_motion(chart_results& r)
{
    const chart_options& o = r.options;
    for (temporal_configuration& c : temporal_configurations(o)) {
        chart_temporal next;
        next.configuration = std::move(c);
        find_costs(next, o);
        r.temporal.push_back(std::move(next));
    }
    if (r.temporal.empty())
        return;
    std::optional<chart_model> model;
    bool first = true;
    for (const chart_place& place : places_of(o)) {
        if (!model || model->path != place.model)
            model.emplace(place.model, true);
        // The cpu comes first: its pictures are what the others' are held against. Times are those of the first view.
        std::vector<contestant> field;
        for (std::size_t i = 0; i < r.temporal.size(); ++i)
            field.push_back(make_contestant(r, "cpu", i, first));
        for (const std::string& backend : o.backends)
            for (std::size_t i = 0; first && backend != "cpu" && i < r.temporal.size(); ++i)
                field.push_back(make_contestant(r, backend, i, true));
        std::vector<std::string> motions{ "static", "pan" };
        if (place.model == "courtyard")
            motions.emplace_back("orbit");
        for (const std::string& words : motions) {
            animated_view view(place, *model, words, o);
            motion_run(r, place, words, view).frames(field);
        }
        first = false;
    }
}

} // namespace ao::tools
