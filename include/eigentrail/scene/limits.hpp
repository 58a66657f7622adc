// How much a scene may hold. Scenes come from anywhere: what is beyond these limits is refused with a message
// before it can exhaust memory, the stack or anybody's patience. All lie far above what a scene needs.
#pragma once

#include <cstddef>

namespace eigentrail::limits {

/// Bytes of a scene file: matrices written out take the most; larger ones belong into HDF5.
inline constexpr std::size_t scene_bytes = 16U << 20U;

/// Tables and lists in each other, and parts of a dotted key: [[body]] markers take five. Reading and taking
/// apart goes down by recursion.
inline constexpr int toml_nesting = 16;
inline constexpr int key_parts = 32;

/// Characters of a key, and of any other text. Names appear in messages and are compared with all others.
inline constexpr std::size_t key_length = 200;
inline constexpr std::size_t text_length = 4096;

/// Tables of one kind, such as [[spring]]: some parts of the model are compared pair by pair.
inline constexpr std::size_t tables_of_a_kind = 10000;

/// Parameters of a scene: definitions may form a chain as long as that, which is followed by recursion.
inline constexpr std::size_t parameters = 1000;

/// Numbers in a list, such as harmonics to look for: each is looked for at every step.
inline constexpr std::size_t list_length = 1000;

/// Characters of an expression, and parentheses in parentheses, which are read by recursion.
inline constexpr std::size_t expression_length = text_length;
inline constexpr int expression_nesting = 100;

/// Operations of an expression that was put together from others, and of all that are made of a scene, 100
/// MB: turning a direction several times repeats the angles' expressions in every component. A joint between
/// two bodies that are both turned by parameters takes some ten thousand.
inline constexpr std::size_t expression_operations = 100'000;
inline constexpr std::size_t scene_operations = 4'000'000;

/// Rows of the matrices of a family, which are solved densely; powers of the parameter, whose series would
/// lose all digits beyond; numbers of all its matrices together, 1.6 GB.
inline constexpr int matrix_rows = 5000;
inline constexpr int matrix_power = 16;
inline constexpr std::size_t matrix_numbers = 200'000'000;

}  // namespace eigentrail::limits
