// SPDX-License-Identifier: Apache-2.0
// A record of the hit stream in a file; layout known to model/raydix/rtl.py.
#pragma once
#include <cstdint>

struct Record {
    std::uint16_t x, y;
    std::uint8_t surface, hit, last, enters;
    std::uint32_t t;
    std::int32_t depth;
    std::int32_t point[3];
    std::uint32_t steps;
};
static_assert(sizeof(Record) == 32);

// Clocks without an event after which a run ends: more than the longest ray takes, 2^20 steps of less than 256 clocks
constexpr std::uint64_t Patience = 1ull << 28;
constexpr char Silence[] = "nothing moved for 2^28 cycles";
