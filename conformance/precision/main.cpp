// `./lapilli precision`: measures every function of the driver under test, over all operands where there is one, and
// writes docs/precision.md. The peer is measured on a sample.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "harness/devices.h"
#include "precision/measure.h"

namespace {

using namespace lapilli;
using namespace lapilli::precision;

struct Arguments {
  uint32_t stride = 1;
  size_t calls = size_t{1} << 24;
  uint32_t peer_stride = 1009;
  std::vector<std::string> only;
  std::string output = "docs/precision.md";
};

std::string number(double value) {
  char text[32];
  if (std::isinf(value)) return "∞";
  std::snprintf(text, sizeof text, value != 0 && (value < 0.01 || value >= 1e5) ? "%.1e" : "%.4g", value);
  return text;
}

std::string place(const Worst& worst) {
  std::string out;
  for (const float x : worst.operands) {
    char text[32];
    std::snprintf(text, sizeof text, "%s%a", out.empty() ? "" : ", ", double(x));
    out += text;
  }
  return out.size() > 60 ? out.substr(0, out.find(',')) + ", …" : out;
}

struct Row {
  Measured ours;
  Measured peer;
};

void table(std::ostream& out, const std::vector<Row>& rows, bool peer) {
  out << "| function | calls | largest error, ULP | at | promised | specification | of that, at most |"
      << (peer ? " peer: ULP | of the bound |" : "") << "\n|---|---|---|---|---|---|---|" << (peer ? "---|---|" : "")
      << '\n';
  for (const Row& row : rows) {
    const Measured& ours = row.ours;
    out << "| " << ours.name << " | " << number(double(ours.calls)) << " | "
        << (std::isinf(ours.promised) ? "–" : number(ours.ulp.value)) << " | "
        << (std::isinf(ours.promised) ? "" : place(ours.ulp)) << " | "
        << (std::isinf(ours.promised) ? "–" : number(ours.promised)) << " | " << ours.bound << " | "
        << number(ours.share.value) << " |";
    if (peer)
      out << ' ' << (std::isinf(ours.promised) ? "–" : number(row.peer.ulp.value)) << " | "
          << number(row.peer.share.value) << " |";
    out << '\n';
  }
}

bool within(const Row& row) {
  const Measured& ours = row.ours;
  const bool promised = ours.ulp.value <= ours.promised && ours.special.value == 0;
  return ours.share.value <= 1 && (promised || !conformance::subject_is_lapilli());
}

template <typename Functions, typename Measure>
std::vector<Row> rows_of(const Functions& functions, const std::vector<std::string>& only, const Measure& measure_one) {
  std::vector<Row> rows;
  for (const auto& function : functions) {
    if (!only.empty() && std::find(only.begin(), only.end(), function.name) == only.end()) continue;
    std::fprintf(stderr, "precision: %s", function.name);
    rows.push_back(measure_one(function));
    std::fprintf(stderr, "  %s ULP%s\n", number(rows.back().ours.ulp.value).c_str(),
                 within(rows.back()) ? "" : "  TOO LARGE");
  }
  return rows;
}

std::string text_of(const Edge& edge) {
  std::string out;
  for (const float value : edge.result) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", double(value));
    out += (out.empty() ? "" : ", ") + std::string(std::isnan(value) ? "NaN" : text);
  }
  return out;
}

int report(const Arguments& arguments) {
  const samples::Context& subject = conformance::subject();
  const samples::Context* const peer = conformance::peer();
  const Judge judge = conformance::subject_is_lapilli() ? Judge::everything : Judge::specified;
  const auto peer_row = [&](const auto& function, auto... how) {
    return peer != nullptr ? measure(*peer, Judge::specified, function, how...) : Measured{};
  };
  const std::vector<Row> one = rows_of(functions_of_one(), arguments.only, [&](const OneOperand& function) {
    return Row{measure(subject, judge, function, arguments.stride), peer_row(function, arguments.peer_stride)};
  });
  const std::vector<Row> several =
      rows_of(functions_of_several(), arguments.only, [&](const SeveralOperands& function) {
        return Row{measure(subject, judge, function, arguments.calls, 1u),
                   peer_row(function, arguments.calls / 16, 1u)};
      });

  std::ostringstream out;
  out << "# Precision\n\nWritten by `./lapilli precision`; do not edit. Device: " << conformance::subject_name()
      << (peer != nullptr ? "; peer: lavapipe (on a sample of the operands)" : "")
      << ".\nThe functions run in a compute shader through the stock loader and are compared with float64. One ULP is "
         "the distance of "
         "two neighbouring float32 at the\nexact value. \"Of that, at most\": the largest error in parts of what the "
         "specification "
         "allows at the operands (Vulkan, \"Precision of Individual\nOperations\"; a formula means that the bound is "
         "inherited from it, "
         "step by step, and ends where a step overflows); 1 is the limit. The bits are the\nsame on every machine: "
         "`lane_math_test` "
         "compares the SIMD targets.\n\n## One operand: "
      << (arguments.stride == 1
              ? "all 2^32 of them"
              : "one in " + std::to_string(arguments.stride) + " of 2^32 (`--stride 1`: all, in hours)")
      << "\n\n";
  table(out, one, peer != nullptr);
  out << "\n## Several operands: special values in all pairs, any bits, moderate numbers\n\nWhere terms cancel, an "
         "error has no measure in "
         "ULP of the result: the specification's bound counts, and errors in ULP are taken where it has one.\n\n";
  table(out, several, peer != nullptr);
  bool good = std::all_of(one.begin(), one.end(), within) && std::all_of(several.begin(), several.end(), within);

  if (conformance::subject_is_lapilli()) {
    out << "\n## At the edges\n\n| | result |\n|---|---|\n";
    for (const Edge& edge : edges()) {
      good = good && same(run_edge(subject, edge), edge.result);
      out << "| " << edge.text << " | " << text_of(edge) << " |\n";
    }
    out << "\nIntegers: x / 0 is all ones (unsigned) or 0 (signed), x % 0 is x, INT_MIN / -1 is INT_MIN with remainder "
           "0; shifts take the "
           "low five bits of\ntheir width; a float that does not fit an integer gives the nearest one, NaN gives 0. "
           "`ops.def` states each op; "
           "`op_test` and `int_test` check them.\n";
  }
  std::ofstream(arguments.output) << out.str();
  std::fprintf(stderr, "precision: %s; %s\n",
               good ? "every row is within its bound" : "NOT every row is within its bound", arguments.output.c_str());
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  CLI::App app("Measures the precision of every function on the driver under test (LAPILLI_ICD) and its peer.");
  app.add_option("--stride", arguments.stride, "every how manieth of the 2^32 operands")->check(CLI::PositiveNumber);
  app.add_option("--peer-stride", arguments.peer_stride, "the same for the peer")->check(CLI::PositiveNumber);
  app.add_option("--calls", arguments.calls, "calls of functions of several operands")->check(CLI::PositiveNumber);
  app.add_option("--only", arguments.only, "only these functions (sin,pow)")->delimiter(',');
  app.add_option("--out", arguments.output, "file to write")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  conformance::choose_drivers();
  const int result = report(arguments);
  conformance::destroy_devices();
  return result;
} catch (const std::exception& error) {
  std::fprintf(stderr, "lapilli_precision: %s\n", error.what());
  return 1;
}
