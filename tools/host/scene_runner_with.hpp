// What is the same for every backend's scene_runner.
#pragma once

#include "ao/half.hpp"
#include "host/scene_runner.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace ao::host {

// What a picture is for while something runs.
enum class picture_use { target, read, written };

// A picture that there is, and its use.
template <class Texture>
struct used_picture {
    Texture* picture = nullptr;
    picture_use use = picture_use::read;
};

// Host: what a backend adds.
//   types       rasterizer, shading, image, and texture: an image's memory, with its format
//   describing  backend(), device(), route(), exact(), messages()
//   creating    rasterizer& drawing(), shading& shader()
//   enter()     what must be so before any other call and before anything is destroyed; a context made current
//   make(format, width, height) -> result<texture>; upload(texture&, picture), download(texture&, picture&) -> result<success>
//   image_of(texture&, use) -> image: as what it is bound
//   run(uses, record) -> result<double>: calls record(commands) when every picture is ready for its use, and waits; milliseconds
//   counts(model) -> programs and calls.
template <class Host>
class scene_runner_with final : public scene_runner {
public:
    using texture = typename Host::texture;
    using pictures = std::array<std::optional<texture>, scene_picture_count>;

    explicit scene_runner_with(Host host) : host_(std::move(host)) {}
    ~scene_runner_with() override
    {
        static_cast<void>(host_.enter());
        forget_shading();
        forget_scene();
        for (auto& each : pictures_) {
            each.reset();
        }
    }

    std::string_view backend() const override { return host_.backend(); }
    std::string device() const override { return host_.device(); }
    std::string route() const override { return host_.route(); }
    bool exact() const override { return host_.exact(); }
    std::vector<std::string> messages() const override { return host_.messages(); }

    ao::result<success> make_targets(const gbuffer_facts& facts) override
    {
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        forget_shading();
        forget_scene();
        for (auto& each : pictures_) {
            each.reset();
        }
        facts_ = facts;
        for (std::size_t i = 0; i < scene_picture_count; ++i) {
            if (const auto format = format_of(facts, static_cast<scene_picture>(i))) {
                if (const auto done = make(static_cast<scene_picture>(i), *format); !done) {
                    return done.error();
                }
            }
        }
        return success{};
    }

    ao::result<success> load(const scene& s, const gbuffer_facts& facts) override
    {
        auto plan = plan_drawing(s, facts);
        if (!plan) {
            return plan.error();
        }
        if (const auto done = make_targets(plan->facts); !done) {
            return done.error();
        }
        auto model = host_.drawing().load(s, *plan);
        if (!model) {
            return model.error();
        }
        model_.emplace(std::move(*model));
        auto targets = host_.drawing().bind(*model_, { target(scene_picture::depth), target(scene_picture::position),
                                                       target(scene_picture::normal), target(scene_picture::motion),
                                                       target(scene_picture::ids), target(scene_picture::surface),
                                                       target(scene_picture::frame) });
        if (!targets) {
            return targets.error();
        }
        targets_.emplace(std::move(*targets));
        counts_ = host_.counts(*model_);
        counts_.draws = plan->draws.size();
        counts_.variants = plan->variants.size();
        counts_.skipped_triangles = plan->skipped_triangles;
        return success{};
    }

    ao::result<success> move(const scene& s) override
    {
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        if (const auto wrong = host_.drawing().move(*model_, s)) {
            return *wrong;
        }
        return success{};
    }

    ao::result<double> draw(const gbuffer_camera& camera) override
    {
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        const auto folds = [&](const camera_projection& p) { return fold_projection(p, facts_.width, facts_.height); };
        if (const auto folded = folds(camera.projection); !folded) {
            return folded.error();
        }
        if (const auto folded = folds(camera.previous_projection); facts_.motion && !folded) {
            return folded.error();
        }
        return host_.run(uses(picture_use::target),
                         [&](auto commands) { host_.drawing().record(commands, *model_, *targets_, camera); });
    }

    draw_counts counts() const override { return counts_; }

    ao::result<success> upload(scene_picture which, const picture& from) override
    {
        if (const auto fits = check_upload(facts_, which, from); !fits) {
            return fits.error();
        }
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        const auto& to = pictures_[static_cast<std::size_t>(which)];
        if (!to || to->format != from.format) {
            return error(errc::plan_mismatch, "the plan that is prepared reads no visibility of this format");
        }
        return host_.upload(*pictures_[static_cast<std::size_t>(which)], from);
    }

    ao::result<picture> download(scene_picture which) override
    {
        auto& from = pictures_[static_cast<std::size_t>(which)];
        if (!from) {
            return error(errc::plan_mismatch, std::string("there is no ") + host::name(which) + " picture");
        }
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        picture to(from->format, facts_.width, facts_.height);
        if (const auto done = host_.download(*from, to); !done) {
            return done.error();
        }
        return to;
    }

    ao::result<success> prepare_shading(const shade_plan& p, const texel_heap& heap) override
    {
        if (const auto fits = check_plan(facts_, p); !fits) {
            return fits.error();
        }
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        forget_shading();
        if (const auto done = make(scene_picture::color, pixel_format::rgba32f); !done) {
            return done.error();
        }
        if (p.options.visibility) {
            if (const auto done = make_visibility(p.facts.visibility_format); !done) {
                return done.error();
            }
        }
        plan_ = p;
        auto program = host_.shader().prepare_shading(plan_, heap);
        if (!program) {
            return program.error();
        }
        program_.emplace(std::move(*program));
        shade_images<typename Host::image> images{};
        images.depth = input(!p.facts.stored_position, scene_picture::depth);
        images.position = input(p.facts.stored_position, scene_picture::position);
        images.normal = input(true, scene_picture::normal);
        images.ids = input(true, scene_picture::ids);
        images.surface = input(p.options.maps, scene_picture::surface);
        images.frame = input(p.options.frames, scene_picture::frame);
        images.visibility = input(p.options.visibility, scene_picture::visibility);
        images.color = image(scene_picture::color, picture_use::written);
        auto bound = host_.shader().bind_shading(*program_, plan_, images);
        if (!bound) {
            return bound.error();
        }
        bound_.emplace(std::move(*bound));
        return success{};
    }

    ao::result<success> update_shading(const shade_plan& p) override
    {
        if (p.passes.size() != plan_.passes.size() || !(p.options == plan_.options)) {
            return error(errc::plan_mismatch, "shading was prepared for another plan");
        }
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        if (const auto wrong = host_.shader().update_table(*program_, p)) {
            return *wrong;
        }
        plan_ = p;
        return success{};
    }

    ao::result<double> shade() override
    {
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        return host_.run(uses(picture_use::read), [&](auto commands) {
            for (std::size_t i = 0; i < plan_.passes.size(); ++i) {
                host_.shader().record_shading(commands, *program_, *bound_, plan_, i);
            }
        });
    }

    ao::result<std::uint64_t> clamped_weights() override
    {
        if (const auto entered = host_.enter(); !entered) {
            return entered.error();
        }
        return host_.shader().clamped_weights(*program_);
    }

private:
    ao::result<success> make(scene_picture which, pixel_format format)
    {
        auto made = host_.make(format, facts_.width, facts_.height);
        if (!made) {
            return made.error();
        }
        pictures_[static_cast<std::size_t>(which)].emplace(std::move(*made));
        return success{};
    }
    ao::result<success> make_visibility(pixel_format format)
    {
        if (const auto done = make(scene_picture::visibility, format); !done) {
            return done.error();
        }
        picture open(format, facts_.width, facts_.height);
        for (std::size_t i = 0; i < open.pixels(); ++i) {
            if (format == pixel_format::r8) {
                open.set_texel(i, std::uint8_t{ 255 });
            }
            else if (format == pixel_format::rgba16f) {
                // No direction: the normal stands for it.
                open.set_texel(i,
                               std::array{ float_to_half(1.0F), float_to_half(0.0F), float_to_half(0.0F), float_to_half(0.0F) });
            }
            else {
                open.set_texel(i, 1.0F);
            }
        }
        return host_.upload(*pictures_[static_cast<std::size_t>(scene_picture::visibility)], open);
    }
    typename Host::image image(scene_picture which, picture_use use)
    {
        auto& there = pictures_[static_cast<std::size_t>(which)];
        return there ? host_.image_of(*there, use) : typename Host::image{};
    }
    typename Host::image target(scene_picture which) { return image(which, picture_use::target); }
    typename Host::image input(bool read, scene_picture which)
    {
        return read ? image(which, picture_use::read) : typename Host::image{};
    }
    // Drawing has targets alone; shading reads them and the visibility, and writes the color.
    std::array<used_picture<texture>, scene_picture_count> uses(picture_use of_targets)
    {
        std::array<used_picture<texture>, scene_picture_count> all{};
        for (std::size_t i = 0; i < scene_picture_count; ++i) {
            const auto which = static_cast<scene_picture>(i);
            const bool beside = which == scene_picture::visibility || which == scene_picture::color;
            if (pictures_[i] && !(beside && of_targets == picture_use::target)) {
                all[i] = { &*pictures_[i], which == scene_picture::color ? picture_use::written : of_targets };
            }
        }
        return all;
    }
    void forget_shading()
    {
        bound_.reset();
        program_.reset();
        pictures_[static_cast<std::size_t>(scene_picture::visibility)].reset();
        pictures_[static_cast<std::size_t>(scene_picture::color)].reset();
    }
    void forget_scene()
    {
        targets_.reset();
        model_.reset();
        counts_ = {};
    }

    Host host_;
    gbuffer_facts facts_;
    pictures pictures_;
    draw_counts counts_;
    std::optional<typename Host::rasterizer::model> model_;
    std::optional<typename Host::rasterizer::targets> targets_;
    shade_plan plan_;
    std::optional<typename Host::shading::shade_program> program_;
    std::optional<typename Host::shading::shade_binding> bound_;
};

} // namespace ao::host
