// SPDX-License-Identifier: Apache-2.0
// Runs frames through rdx_top at full simulation speed, as a host would: registers and tables by AXI4-Lite, pixels by AXI4-Stream.
//
//   top PROGRAM PIXELS IMAGE RECORDS [--stall SEED] [--trace FILE] [--progress PIXELS]
//
// PROGRAM  file of operations, four 32-bit words each: kind, address, data, mask. Kind 0 writes data; 1 reads until the bits of mask
//          are those of data; 2 reads, and prints the value; 3 waits for the interrupt.
// PIXELS   pixels in all; the run ends when they have come and the program is done
// IMAGE    file written: R, G, B of each pixel in order of arrival
// RECORDS  file written: one Record for each record of the rings
// --stall  holds back the channels of both buses at random
// --trace, --progress   as in frame.cpp
// Prints one line of JSON: cycles, values read, frames and lines that were marked, seconds of simulation.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "Vrdx_top.h"
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

struct Operation {
    std::uint32_t kind, address, data, mask;
};

// Fields of rdx_pkg::hit_t by their lowest bit
template <typename Wide>
static std::uint32_t field(const Wide& wide, int low, int width) {
    std::uint64_t value = wide[low / 32];
    if (low % 32 + width > 32) value |= static_cast<std::uint64_t>(wide[low / 32 + 1]) << 32;
    return static_cast<std::uint32_t>(value >> low % 32 & ((1ull << width) - 1));
}

template <typename Wide>
static Record record_of(const Wide& hit) {
    Record r{};
    int at = 0;
    auto next = [&](int width) { return at += width, field(hit, at - width, width); };
    r.steps = next(20);
    r.enters = next(1);
    for (int i = 0; i < 3; i++) r.point[i] = static_cast<std::int32_t>(next(32));
    r.depth = static_cast<std::int32_t>(next(32));
    r.t = next(32);
    r.last = next(1);
    r.hit = next(1);
    r.y = next(12);
    r.x = next(12);
    r.surface = next(6);
    return r;
}

template <std::size_t Words>
static std::uint8_t byte_of(const VlWide<Words>& data, int i) {
    return data[i / 4] >> 8 * (i % 4) & 255;
}
static std::uint8_t byte_of(std::uint64_t data, int i) { return data >> 8 * i & 255; }

static int fail(const char* what, const char* which = "") {
    std::fprintf(stderr, "top: %s%s\n", what, which);
    return 2;
}

int main(int argc, char** argv) {
    if (argc < 5) return fail("usage: top PROGRAM PIXELS IMAGE RECORDS [--stall SEED] [--trace FILE]");
    const std::uint64_t wanted = std::strtoull(argv[2], nullptr, 10);
    bool stall = false;
    std::uint64_t report = 0;
    std::mt19937_64 random;
    std::string trace_name;
    for (int i = 5; i + 1 < argc; i += 2) {
        if (!std::strcmp(argv[i], "--stall")) stall = true, random.seed(std::strtoull(argv[i + 1], nullptr, 10));
        else if (!std::strcmp(argv[i], "--trace")) trace_name = argv[i + 1];
        else if (!std::strcmp(argv[i], "--progress")) report = std::strtoull(argv[i + 1], nullptr, 10);
        else return fail("unknown option ", argv[i]);
    }
    std::vector<Operation> program;
    std::FILE* in = std::fopen(argv[1], "rb");
    if (!in) return fail("cannot read ", argv[1]);
    for (Operation o; std::fread(&o, sizeof o, 1, in) == 1;) program.push_back(o);
    std::fclose(in);
    std::vector<std::uint8_t> image;
    image.reserve(3 * wanted);
    std::vector<Record> records;
    std::string values;

    VerilatedContext context;
    Vrdx_top top{&context};
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
    top.rst_ni = 0;
    top.axil_awvalid_i = top.axil_wvalid_i = top.axil_arvalid_i = top.axil_bready_i = top.axil_rready_i = 0;
    top.m_axis_tready_i = 0;
    for (int i = 0; i < 4; i++) tick();
    top.rst_ni = 1;

    const auto started = std::chrono::steady_clock::now();
    constexpr int pixels = sizeof(top.m_axis_tdata_o) >= 12 ? 4 : sizeof(top.m_axis_tdata_o) == 8 ? 2 : 1;
    std::uint64_t cycles = 0, quiet = 0, pixels_seen = 0, first = 0, last = 0, frames = 0, lines = 0;
    std::size_t at = 0;
    enum { Idle, Write, Answer, Read, Data } state = Idle;
    while (at < program.size() || pixels_seen < wanted) {
        const std::uint64_t dice = stall ? random() : 0;
        if (state == Idle && at < program.size() && !(dice & 1)) {
            const Operation& o = program[at];
            if (o.kind == 0) {
                top.axil_awaddr_i = o.address, top.axil_wdata_i = o.data, top.axil_wstrb_i = 15;
                top.axil_awvalid_i = top.axil_wvalid_i = 1;
                state = Write;
            } else if (o.kind == 3) {
                if (top.irq_o) at++, quiet = 0;
            } else {
                top.axil_araddr_i = o.address, top.axil_arvalid_i = 1;
                state = Read;
            }
        }
        top.axil_bready_i = state == Answer && !(dice & 2);
        top.axil_rready_i = state == Data && !(dice & 2);
        top.m_axis_tready_i = !(dice & 12);
        top.eval();  // ready follows the inputs combinationally
        const bool aw = top.axil_awvalid_i && top.axil_awready_o, w = top.axil_wvalid_i && top.axil_wready_o;
        const bool b = top.axil_bvalid_o && top.axil_bready_i, ar = top.axil_arvalid_i && top.axil_arready_o;
        const bool r = top.axil_rvalid_o && top.axil_rready_i;
        if ((b && top.axil_bresp_o) || (r && top.axil_rresp_o)) return fail("an access was answered by an error");
        if (r) {
            const Operation& o = program[at];
            if (o.kind == 2) values += (values.empty() ? "" : ", ") + std::to_string(top.axil_rdata_o);
            if (o.kind == 2 || (top.axil_rdata_o & o.mask) == o.data) at++, quiet = 0;
        }
        if (top.tap_valid_o) records.push_back(record_of(top.tap_o)), quiet = 0;
        if (top.m_axis_tvalid_o && top.m_axis_tready_i) {
            if (pixels_seen == 0) first = cycles;
            frames += top.m_axis_tuser_o, lines += top.m_axis_tlast_o;
            for (int p = 0; p < pixels; p++) {
                if (!(top.m_axis_tkeep_o >> 3 * p & 1)) continue;
                for (int c = 2; c >= 0; c--) image.push_back(byte_of(top.m_axis_tdata_o, 3 * p + c));
                pixels_seen++;
                if (report && pixels_seen % report == 0) {
                    std::printf("progress %llu\n", static_cast<unsigned long long>(pixels_seen));
                    std::fflush(stdout);
                }
            }
            last = cycles, quiet = 0;
        }
        tick();
        if (aw) top.axil_awvalid_i = 0;
        if (w) top.axil_wvalid_i = 0;
        if (state == Write && !top.axil_awvalid_i && !top.axil_wvalid_i) state = Answer;
        if (ar) top.axil_arvalid_i = 0, state = Data;
        if (b) at++, state = Idle, quiet = 0;
        if (r) state = Idle;
        cycles++;
        if (pixels_seen > wanted) return fail("more pixels than the frames have");
        if (++quiet > Patience) return fail(Silence);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    top.final();
#ifdef RDX_TRACE
    if (!trace_name.empty()) trace.close();
#endif
    std::FILE* out = std::fopen(argv[3], "wb");
    if (!out || std::fwrite(image.data(), 1, image.size(), out) != image.size() || std::fclose(out))
        return fail("cannot write ", argv[3]);
    out = std::fopen(argv[4], "wb");
    if (!out || std::fwrite(records.data(), sizeof(Record), records.size(), out) != records.size() || std::fclose(out))
        return fail("cannot write ", argv[4]);
    std::printf("{\"cycles\": %llu, \"pixel_cycles\": %llu, \"frames\": %llu, \"lines\": %llu, \"values\": [%s], \"seconds\": %.6f}\n",
                static_cast<unsigned long long>(cycles), static_cast<unsigned long long>(last - first + 1),
                static_cast<unsigned long long>(frames), static_cast<unsigned long long>(lines), values.c_str(), seconds);
    return 0;
}
