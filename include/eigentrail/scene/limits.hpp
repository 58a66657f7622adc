// Largest sizes that a scene may have. Scenes may come from untrusted sources: larger ones are refused with a
// message before they exhaust memory, the stack or the user's time. All limits are far above the needs of
// real scenes.
#pragma once

#include <cstddef>

namespace eigentrail::limits {

/// Bytes of a scene file. Matrices in text form need the most; larger matrices should be in HDF5 files.
inline constexpr std::size_t scene_bytes = 16U << 20U;

/// Nesting of tables and lists, and number of parts of a dotted key; [[body]] markers need five. Tables are
/// read and destroyed recursively.
inline constexpr int toml_nesting = 16;
inline constexpr int key_parts = 32;

/// Characters of a key, and of any other text. Names appear in messages and are compared with all others.
inline constexpr std::size_t key_length = 200;
inline constexpr std::size_t text_length = 4096;

/// Number of tables of one kind, such as [[spring]]; parts of the model are compared pair by pair.
inline constexpr std::size_t tables_of_a_kind = 10000;

/// Number of parameters. Definitions may form a chain of this length, which is followed by recursion.
inline constexpr std::size_t parameters = 1000;

/// Numbers in a list, such as harmonics; each of them is searched for on every step.
inline constexpr std::size_t list_length = 1000;

/// Characters of an expression, and nesting of parentheses, which are read recursively.
inline constexpr std::size_t expression_length = text_length;
inline constexpr int expression_nesting = 100;

/// Operations of one expression that is composed of others, and of all expressions of a scene (about 100 MB).
/// Rotating a direction repeatedly copies the expressions of the angles into every component: a joint between
/// two bodies that are both rotated by parameters needs about ten thousand operations.
inline constexpr std::size_t expression_operations = 100'000;
inline constexpr std::size_t scene_operations = 4'000'000;

/// Matrix families: rows of the matrices, which are solved densely; powers of the parameter, beyond which the
/// series would lose all digits; numbers of all matrices together (1.6 GB).
inline constexpr int matrix_rows = 5000;
inline constexpr std::size_t sparse_rows = 5'000'000;  ///< of sparse matrices
inline constexpr int matrix_power = 16;
inline constexpr std::size_t matrix_numbers = 200'000'000;

/// Samples of a sampled family.
inline constexpr std::size_t samples = 1000;

/// Bytes of a text file of another program.
inline constexpr std::size_t text_file_bytes = 1024U << 20U;

}  // namespace eigentrail::limits
