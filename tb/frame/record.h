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
