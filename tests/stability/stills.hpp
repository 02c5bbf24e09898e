// Temporal runs of a subject over the small scene of the unit tests.
#pragma once

#include "stability/subject.hpp"

#include "unit/temporal_scene.hpp"

#include <limits>
#include <vector>

namespace stability {

using history = ao::math<float>::ao_history;

class temporal_run {
public:
    explicit temporal_run(subject& s) : subject_(&s) {}

    ao::temporal_settings settings;
    ao::temporal_facts facts;

    // False where the backend refuses.
    bool start()
    {
        if (subject_->change_temporal) {
            subject_->change_temporal(settings);
        }
        return static_cast<bool>(runner().prepare(settings, facts));
    }
    bool step(const temporal_test::scene_frame& f, bool cut = false)
    {
        return runner().upload(f.inputs.depth, f.inputs.normal, facts.motion ? f.inputs.motion : ao::picture()) &&
               runner().frame(f.camera, cut);
    }
    std::vector<history> histories()
    {
        std::vector<history> all;
        const auto words = runner().history();
        for (std::size_t i = 0; words && i < pixels(); ++i) {
            all.push_back(ao::math<float>::ao_unpacked_history(ao::history_words(*words, settings.format, i),
                                                               static_cast<int>(settings.format)));
        }
        return all;
    }
    bool set_histories(const std::vector<history>& all)
    {
        std::vector<std::uint32_t> words;
        for (const history& h : all) {
            const int format = static_cast<int>(settings.format);
            const glm::uvec4 w = ao::math<float>::ao_packed_history(h, format);
            for (int k = 0; k < ao::math<float>::ao_history_words(format); ++k) {
                words.push_back(w[k]);
            }
        }
        return static_cast<bool>(runner().set_history(words));
    }
    // NaN where there is none.
    std::vector<float> visibility()
    {
        std::vector<float> seen(pixels(), std::numeric_limits<float>::quiet_NaN());
        const auto made = runner().download();
        for (std::size_t i = 0; made && i < seen.size(); ++i) {
            seen[i] = ao::conformance::decode_texel<float>(*made, i).x;
        }
        return seen;
    }
    ao::host::temporal_runner& runner() { return *subject_->temporal(); }
    std::size_t pixels() const
    {
        return static_cast<std::size_t>(facts.frame.width) * static_cast<std::size_t>(facts.frame.height);
    }

private:
    subject* subject_;
};

// A stage that stands still.
class still_run : public temporal_run {
public:
    still_run(subject& s, const glm::ivec2& size, bool motion) : temporal_run(s)
    {
        temporal_test::stage stage;
        stage.width = size.x;
        stage.height = size.y;
        frame = temporal_test::make_frame(stage, stage);
        for (std::size_t i = 0; i < frame.inputs.motion.pixels(); ++i) {
            const auto v = frame.inputs.motion.texel<glm::vec4>(i);
            frame.inputs.motion.set_texel(i, glm::vec4(0, 0, v.z, 0));
        }
        facts = temporal_test::facts_of(stage, motion);
    }
    bool step(bool cut = false) { return temporal_run::step(frame, cut); }

    temporal_test::scene_frame frame;
};

} // namespace stability
