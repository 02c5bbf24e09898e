// Matrices as the public structs hold them: column-major like GLM's, but readable and writable in constant expressions,
// which GLM 0.9.9.8's are not. Convert from GLM's implicitly.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace ao {

// Element of row r and column c is m[c][r]. Identity by default.
template <int N>
struct square_matrix {
    float columns[N][N] = {};

    constexpr square_matrix()
    {
        for (int i = 0; i < N; ++i) {
            columns[i][i] = 1;
        }
    }
    square_matrix(const glm::mat<N, N, float>& m)
    {
        for (int c = 0; c < N; ++c) {
            for (int r = 0; r < N; ++r) {
                columns[c][r] = m[c][r];
            }
        }
    }
    static constexpr square_matrix zero()
    {
        square_matrix m;
        for (int i = 0; i < N; ++i) {
            m.columns[i][i] = 0;
        }
        return m;
    }
    constexpr float* operator[](int column) { return columns[column]; }
    constexpr const float* operator[](int column) const { return columns[column]; }
    glm::mat<N, N, float> to_glm() const
    {
        glm::mat<N, N, float> m;
        for (int c = 0; c < N; ++c) {
            for (int r = 0; r < N; ++r) {
                m[c][r] = columns[c][r];
            }
        }
        return m;
    }
};

using matrix3 = square_matrix<3>;
using matrix4 = square_matrix<4>;

} // namespace ao
