#include "stability/row.hpp"

namespace stability {

std::vector<row> all_rows()
{
    std::vector<row> all;
    for (const auto& rows :
         { frame_rows(), sequence_rows(), warp_rows(), depth_rows(), screen_rows(), poison_rows(), history_rows(), motion_rows(),
           filter_rows(), ray_rows(), material_rows(), repeat_rows(), field_rows() }) {
        all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
}

std::vector<remark> all_remarks()
{
    return {
        { "B2", "B1: sums of weights hold the centre's, so none is 0; a single pixel in background keeps its value" },
        { "7.1", "D1" },
        { "7.2", "D1: at 85 degrees an open plane is 1 for every rotation, so its mean is, too" },
        { "7.3", "S1, S1c" },
        { "7.4", "S5, S5d" },
        { "7.6", "S2, S2p" },
        { "7.7", "S7, 7.21: an open plane is 1 in border pixels, too" },
        { "7.8", "D3, W4s" },
        { "7.13", "S6" },
        { "7.14", "S4, S4r, P1" },
        { "7.15", "D4, P1, P2" },
        { "7.16", "D2, D2o, X2" },
        { "7.17", "X2" },
        { "7.18", "S3, S4r; bounded cost: the number of taps is fixed, no loop depends on the radius" },
        { "7.24", "X8, S7" },
        { "7.26", "F5a" },
        { "7.27", "F6, F6g" },
        { "7.28", "F8" },
        { "7.29", "F1, F1b, F2, H2" },
        { "7.30", "H2, H5, F10: 4096 offsets before any comes again, eight times the greatest weight" },
        { "7.31", "F7" },
        { "7.32", "F10" },
        { "7.33", "F11" },
        { "7.36", "does not apply: inputs have one sample a pixel, and no multisampled depth is read" },
        { "7.37", "P2, P2b, S5: to the passes holes by alpha are background or what lies behind; no pass reads alpha" },
        { "7.38", "tests/unit/vk_*.cpp run every pass under validation and synchronisation layers; gl: tests/unit/gl_state.cpp" },
        { "7.39", "I2; per pass and function: the conformance suite (tests/conformance)" },
        { "7.40", "I1; no pass counts by atomics but that of clamped weights, which changes no pixel" },
    };
}

} // namespace stability
