// SPDX-License-Identifier: Apache-2.0
// Runs one frame through rdx_core at full simulation speed.
//
//   frame WORDS RAYS RECORDS [--stall SEED] [--trace FILE] [--progress RAYS]
//
// WORDS    file of 64-bit descriptor words     RAYS     rays in all; the run ends with the last record of the last one
// RECORDS  file written: one Record per transfer of the hit stream, in order of arrival
// --stall  holds back the descriptor and the hit stream at random
// --trace  writes a waveform (where built with one)
// --progress  prints a line "progress N" after each RAYS rays
// Prints one line of JSON: cycles, rays, records, seconds of simulation.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "Vrdx_core.h"
#include "verilated.h"
#if defined(RDX_TRACE_FST)
#include "verilated_fst_c.h"
using Trace = VerilatedFstC;
#define RDX_TRACE
#elif defined(RDX_TRACE_VCD)
#include "verilated_vcd_c.h"
using Trace = VerilatedVcdC;
#define RDX_TRACE
#endif

#include "record.h"

static int fail(const char* what, const char* which = "") {
    std::fprintf(stderr, "frame: %s%s\n", what, which);
    return 2;
}

int main(int argc, char** argv) {
    if (argc < 4) return fail("usage: frame WORDS RAYS RECORDS [--stall SEED] [--trace FILE]");
    const std::uint64_t rays = std::strtoull(argv[2], nullptr, 10);
    bool stall = false;
    std::uint64_t report = 0;
    std::mt19937_64 random;
    std::string trace_name;
    for (int i = 4; i + 1 < argc; i += 2) {
        if (!std::strcmp(argv[i], "--stall")) stall = true, random.seed(std::strtoull(argv[i + 1], nullptr, 10));
        else if (!std::strcmp(argv[i], "--trace")) trace_name = argv[i + 1];
        else if (!std::strcmp(argv[i], "--progress")) report = std::strtoull(argv[i + 1], nullptr, 10);
        else return fail("unknown option ", argv[i]);
    }

    std::vector<std::uint64_t> words;
    std::FILE* in = std::fopen(argv[1], "rb");
    if (!in) return fail("cannot read ", argv[1]);
    for (std::uint64_t w; std::fread(&w, sizeof w, 1, in) == 1;) words.push_back(w);
    std::fclose(in);
    std::vector<Record> records;
    records.reserve(rays);

    VerilatedContext context;
    Vrdx_core top{&context};
#ifdef RDX_TRACE
    Trace trace;
    if (!trace_name.empty()) {
        context.traceEverOn(true);
        top.trace(&trace, 99);
        trace.open(trace_name.c_str());
        if (!trace.isOpen()) return fail("cannot write ", trace_name.c_str());
    }
#else
    if (!trace_name.empty()) return fail("built without --trace");
#endif
    auto tick = [&] {
        for (int level : {1, 0}) {
            top.clk_i = level;
            top.eval();
            context.timeInc(1);
#ifdef RDX_TRACE
            if (!trace_name.empty()) trace.dump(context.time());
#endif
        }
    };

    top.clk_i = 0;
    top.rst_ni = 0;
    top.desc_valid_i = 0;
    top.hit_ready_i = 0;
    top.eval();
    for (int i = 0; i < 4; i++) tick();
    top.rst_ni = 1;

    const auto started = std::chrono::steady_clock::now();
    std::uint64_t cycles = 0, finished = 0, quiet = 0;
    std::size_t sent = 0;
    bool offered = false;
    while (finished < rays) {
        const std::uint64_t dice = stall ? random() : 0;
        // a word once offered stays until it is taken
        offered = sent < words.size() && (offered || !(dice & 1));
        top.desc_valid_i = offered;
        top.desc_data_i = offered ? words[sent] : 0;
        top.hit_ready_i = !(dice & 6);
        top.eval();  // ready follows the inputs combinationally
        const bool taken = offered && top.desc_ready_o;
        if (top.hit_valid_o && top.hit_ready_i) {
            Record r{};
            r.x = top.hit_x_o, r.y = top.hit_y_o, r.surface = top.hit_surface_o;
            r.hit = top.hit_hit_o, r.last = top.hit_last_o, r.enters = top.hit_enters_o, r.t = top.hit_t_o;
            r.depth = static_cast<std::int32_t>(top.hit_depth_o);
            for (int i = 0; i < 3; i++) r.point[i] = static_cast<std::int32_t>(top.hit_point_o[i]);
            r.steps = top.hit_steps_o;
            records.push_back(r);
            finished += r.last;
            quiet = 0;
            if (report && r.last && finished % report == 0) {
                std::printf("progress %llu\n", static_cast<unsigned long long>(finished));
                std::fflush(stdout);
            }
        }
        tick();
        if (taken) sent++, offered = false, quiet = 0;
        cycles++;
        if (++quiet > Patience) return fail(Silence);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    // nothing more may come
    top.desc_valid_i = 0;
    top.hit_ready_i = 1;
    for (int i = 0; i < 4096; i++) {
        tick();
        if (top.hit_valid_o) return fail("a record after the last one");
    }
    if (sent != words.size()) return fail("descriptor words left over");
    top.final();
#ifdef RDX_TRACE
    if (!trace_name.empty()) trace.close();
#endif

    std::FILE* out = std::fopen(argv[3], "wb");
    if (!out || std::fwrite(records.data(), sizeof(Record), records.size(), out) != records.size() || std::fclose(out))
        return fail("cannot write ", argv[3]);
    std::printf("{\"cycles\": %llu, \"rays\": %llu, \"records\": %zu, \"seconds\": %.6f}\n",
                static_cast<unsigned long long>(cycles), static_cast<unsigned long long>(finished), records.size(),
                seconds);
    return 0;
}
