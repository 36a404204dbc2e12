// What is invalid or not supported is refused, and the message names it.
#include "shader/spirv/test/assembler.h"

namespace lapilli {
namespace {

using spv::Op;

#define EXPECT_REFUSED(needle, ...)                                                \
  {                                                                                \
    const std::string text = outcome_of([&](Assembler& a) { __VA_ARGS__; });       \
    EXPECT_NE(text.find(needle), std::string::npos) << "the message is: " << text; \
  }

TEST(SpirvRefuse, TheUnchangedModuleIsFine) {
  EXPECT_EQ(outcome_of([](Assembler&) {}), "");
}

TEST(SpirvRefuse, Header) {
  std::vector<uint32_t> words = Assembler().words();
  EXPECT_NE(outcome({}).find("shorter than its header"), std::string::npos);
  words[0] = 1;
  EXPECT_NE(outcome(words).find("magic number"), std::string::npos);
  EXPECT_REFUSED("version 1.4", a.version = 0x00010400);
  words = Assembler().words();
  words[3] = 0xFFFFFFFF;
  EXPECT_NE(outcome(words).find("bound"), std::string::npos);
}

TEST(SpirvRefuse, EntryPoint) {
  EXPECT_NE(outcome(Assembler().words(), "other").find("no GLCompute entry point \"other\""), std::string::npos);
}

TEST(SpirvRefuse, WhatIsNotSupportedByName) {
  EXPECT_REFUSED("capability Float64", a.add(a.head, Op::OpCapability, {10}));
  EXPECT_REFUSED("capability Geometry", a.add(a.head, Op::OpCapability, {2}));
  EXPECT_REFUSED("64-bit floats", a.add(a.globals, Op::OpTypeFloat, {20, 64}));
  EXPECT_REFUSED("16-bit integers", a.add(a.globals, Op::OpTypeInt, {20, 16, 0}));
  EXPECT_REFUSED("CrossWorkgroup", a.add(a.globals, Op::OpTypePointer, {20, 5, kUint}));
  EXPECT_REFUSED("Cube", a.add(a.globals, Op::OpTypeImage, {20, kFloat, 3, 0, 0, 0, 1, 0}));
  EXPECT_REFUSED("SubpassData", a.add(a.globals, Op::OpTypeImage, {20, kFloat, 6, 0, 0, 0, 2, 0}));
  EXPECT_REFUSED("arrayed images", a.add(a.globals, Op::OpTypeImage, {20, kFloat, 1, 0, 1, 0, 2, 1}));
  EXPECT_REFUSED("multisampled images", a.add(a.globals, Op::OpTypeImage, {20, kFloat, 1, 0, 0, 1, 2, 1}));
  EXPECT_REFUSED("OpImageSparseRead", a.add(a.body, Op::OpImageSparseRead, {kFloat, 20, kOne, kOne}));
  EXPECT_REFUSED("scope is more than a workgroup", a.add(a.body, Op::OpControlBarrier, {kOne, kOne, kOne}));
  EXPECT_REFUSED("extension SPV_X", a.add(a.head, Op::OpExtension, {0x5F565053, 0x58}));
  EXPECT_REFUSED("instruction set OpenCL", a.add(a.head, Op::OpExtInstImport, {20, 0x6E65704F, 0x4C43}));
  EXPECT_REFUSED("is no pointer that has a value here",
                 a.add(a.head, Op::OpExtInstImport, {20, 0x4C534C47, 0x6474732E, 0x3035342E, 0});
                 a.add(a.body, Op::OpExtInst, {kFloat, 21, 20, 76, kOne}));
  EXPECT_REFUSED("built-in SubgroupSize is not supported", {
    a.add(a.annotations, Op::OpDecorate, {22, 11, 36});
    a.add(a.globals, Op::OpTypePointer, {21, 1, kUint});
    a.add(a.globals, Op::OpVariable, {21, 22, 1});
    a.head.clear();
    a.add(a.head, Op::OpCapability, {1});
    a.add(a.head, Op::OpEntryPoint, {5, kMain, 0x6E69616D, 0, 22});
  });
}

// A sampled image, and one instruction that uses it.
void sample_with(Assembler& a, Op op, std::initializer_list<uint32_t> operands) {
  enum : uint32_t { kImage = 20, kSampled, kPointer, kVariable, kFloat2, kFloat4, kZero, kCoordinate, kInt2, kOffset };
  a.add(a.annotations, Op::OpDecorate, {kVariable, 34, 0});
  a.add(a.annotations, Op::OpDecorate, {kVariable, 33, 0});
  a.add(a.globals, Op::OpTypeImage, {kImage, kFloat, 1, 0, 0, 0, 1, 0});
  a.add(a.globals, Op::OpTypeSampledImage, {kSampled, kImage});
  a.add(a.globals, Op::OpTypePointer, {kPointer, 0, kSampled});
  a.add(a.globals, Op::OpVariable, {kPointer, kVariable, 0});
  a.add(a.globals, Op::OpTypeVector, {kFloat2, kFloat, 2});
  a.add(a.globals, Op::OpTypeVector, {kFloat4, kFloat, 4});
  a.add(a.globals, Op::OpConstant, {kFloat, kZero, 0});
  a.add(a.globals, Op::OpConstantComposite, {kFloat2, kCoordinate, kZero, kZero});
  a.add(a.globals, Op::OpTypeVector, {kInt2, kUint, 2});
  a.add(a.globals, Op::OpConstantComposite, {kInt2, kOffset, kOne, kOne});
  a.add(a.body, Op::OpLoad, {kSampled, 40, kVariable});
  std::vector<uint32_t> words{kFloat4, 41, 40, kCoordinate};
  words.insert(words.end(), operands);
  a.body.push_back(static_cast<uint32_t>(op) | static_cast<uint32_t>(words.size() + 1) << 16);
  a.body.insert(a.body.end(), words.begin(), words.end());
}

TEST(SpirvRefuse, ImageOperands) {
  constexpr uint32_t kZero = 26, kOffset = 29;
  const std::vector<BindingSlot> slots = {{0, 0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_ALL, 0, 1}};
  const auto outcome_with = [&](Op op, std::initializer_list<uint32_t> operands, bool extended = false) {
    Assembler a;
    if (extended) a.add(a.head, Op::OpCapability, {static_cast<uint32_t>(spv::Capability::ImageGatherExtended)});
    sample_with(a, op, operands);
    const Result<std::shared_ptr<const SpirvModule>> module = parse_spirv(a.words());
    if (!module) return module.error().message;
    const Result<Code> code = make_compute_code({*module, "main", {}}, {slots, 0});
    return code.ok() ? verify(*code) : code.error().message;
  };
  const auto expect = [](const std::string& text, const char* needle) {
    EXPECT_NE(text.find(needle), std::string::npos) << needle << ": " << text;
  };
  const Op sample = Op::OpImageSampleExplicitLod, gather = Op::OpImageGather;
  EXPECT_EQ(outcome_with(sample, {2, kZero}), "");
  EXPECT_EQ(outcome_with(sample, {2 | 8, kZero, kOffset}), "");
  EXPECT_EQ(outcome_with(gather, {kOne, 16, kOffset}, true), "");
  expect(outcome_with(gather, {kOne, 16, kOffset}), "ImageGatherExtended");
  expect(outcome_with(sample, {0}), "neither Lod nor Grad");
  expect(outcome_with(sample, {1, kZero}), "operand Bias is not supported");
  expect(outcome_with(sample, {2 | 64, kZero, kOne}), "operand Sample is not supported");
  expect(outcome_with(sample, {2 | 128, kZero, kZero}), "operand MinLod is not supported");
  expect(outcome_with(sample, {2 | 4, kZero, kZero, kZero}), "contradict");
  expect(outcome_with(sample, {2 | 8, kZero}), "not as many");
  expect(outcome_with(sample, {2 | 8, kZero, kZero}), "number of components");
  expect(outcome_with(Op::OpImageSampleProjExplicitLod, {2, kZero}), "too few components");
  expect(outcome_with(Op::OpImageFetch, {}), "wrong type");
  expect(outcome_with(Op::OpImageQueryLod, {}), "fragment shaders");
  expect(outcome_with(Op::OpImageSparseSampleExplicitLod, {2, kZero}), "not supported");
}

TEST(SpirvRefuse, MessagesNameInstructionWordNameAndLine) {
  const std::string text = outcome_of([](Assembler& a) {
    a.add(a.head, Op::OpString, {30, 0x65642E61, 0x0062});  // "a.deb"
    a.add(a.head, Op::OpName, {31, 0x006D7573});            // "sum"
    a.add(a.body, Op::OpLine, {30, 17, 1});
    a.add(a.body, Op::OpFAdd, {kFloat, 31, kOne, kOne});
  });
  EXPECT_TRUE(text.starts_with("SPIR-V: OpFAdd %31 \"sum\" at word ")) << text;
  EXPECT_NE(text.find("(a.deb:17): %7 has the wrong type"), std::string::npos) << text;
}

TEST(SpirvRefuse, Ids) {
  EXPECT_REFUSED("%50 is not defined", a.add(a.body, Op::OpIAdd, {kUint, 20, 50, kOne}));
  EXPECT_REFUSED("already defined", a.add(a.globals, Op::OpTypeBool, {kUint}));
  EXPECT_REFUSED("not below the bound", a.add(a.globals, Op::OpTypeBool, {100}));
  EXPECT_REFUSED("is no type", a.add(a.body, Op::OpIAdd, {kOne, 20, kOne, kOne}));
  EXPECT_REFUSED("does not dominate", a.add(a.body, Op::OpIAdd, {kUint, 20, 20, kOne}));
  EXPECT_REFUSED("declared further down", a.add(a.globals, Op::OpTypeStruct, {20, 20}));
  EXPECT_REFUSED("too few or too many operands", a.add(a.body, Op::OpIAdd, {kUint, 20, kOne}));
  EXPECT_REFUSED("no such instruction", a.body.push_back(0x0001FFF0));
  EXPECT_REFUSED("leaves the module", a.functions.push_back(0x00500000));
  EXPECT_REFUSED("leaves the module", a.functions.push_back(0x00000000));
}

TEST(SpirvRefuse, ControlFlow) {
  EXPECT_REFUSED("is no block of this function", a.add(a.body, Op::OpBranch, {kOne}); a.add(a.body, Op::OpLabel, {20}));
  EXPECT_REFUSED("first block", a.add(a.body, Op::OpBranch, {kEntryLabel}); a.add(a.body, Op::OpLabel, {20}));
  EXPECT_REFUSED("jumps back", a.add(a.body, Op::OpBranch, {20}); a.add(a.body, Op::OpLabel, {20});
                 a.add(a.body, Op::OpBranch, {20}); a.add(a.body, Op::OpLabel, {21}));
  EXPECT_REFUSED("does not name the blocks", a.add(a.body, Op::OpBranch, {20}); a.add(a.body, Op::OpLabel, {20});
                 a.add(a.body, Op::OpPhi, {kUint, 21, kOne, 20}));
  EXPECT_REFUSED("recursion", a.add(a.body, Op::OpFunctionCall, {kVoid, 20, kMain}));
  EXPECT_REFUSED("no end", a.add(a.body, Op::OpLabel, {20}));
  EXPECT_REFUSED("is for fragment shaders", a.add(a.body, Op::OpKill, {}); a.add(a.body, Op::OpLabel, {20}));
}

TEST(SpirvRefuse, AbsurdSizes) {
  EXPECT_REFUSED("size that is not supported", {
    a.add(a.globals, Op::OpConstant, {kUint, 20, 0x7FFFFFFF});
    a.add(a.globals, Op::OpTypeArray, {21, kFloat, 20});
    a.add(a.globals, Op::OpTypeArray, {22, 21, 20});
    a.add(a.globals, Op::OpTypePointer, {23, 7, 22});
    a.add(a.body, Op::OpVariable, {23, 24, 7});
  });
  EXPECT_REFUSED("from 1 to 1024 invocations", {
    a.add(a.annotations, Op::OpDecorate, {22, 11, 25});
    a.add(a.globals, Op::OpTypeVector, {20, kUint, 3});
    a.add(a.globals, Op::OpConstant, {kUint, 21, 0x10000});
    a.add(a.globals, Op::OpConstantComposite, {20, 22, 21, 21, 21});
  });
}

TEST(SpirvRefuse, LocalSizeIdNamesConstants) {
  const auto sized = [](uint32_t x) {
    Assembler a;
    a.version = 0x00010300;
    a.add(a.globals, Op::OpConstant, {kUint, 20, 33});
    std::vector<uint32_t> words = a.words();
    for (size_t at = 5; at < words.size(); at += words[at] >> 16) {
      if ((words[at] & 0xFFFF) != static_cast<uint32_t>(Op::OpExecutionMode)) continue;
      words[at] = 6u << 16 | static_cast<uint32_t>(Op::OpExecutionModeId);
      const uint32_t operands[] = {static_cast<uint32_t>(spv::ExecutionMode::LocalSizeId), x, kOne, kOne};
      std::copy(std::begin(operands), std::end(operands), words.begin() + static_cast<std::ptrdiff_t>(at) + 2);
    }
    return words;
  };
  EXPECT_NE(outcome(sized(99)).find("LocalSizeId has a size that is no constant"), std::string::npos);
  EXPECT_NE(outcome(sized(0xFFFFFFFF)).find("LocalSizeId has a size that is no constant"), std::string::npos);
  const Result<std::shared_ptr<const SpirvModule>> module = parse_spirv(sized(20));
  ASSERT_TRUE(module.ok()) << module.error().message;
  const Result<Code> code = make_compute_code({*module, "main", {}}, {});
  ASSERT_TRUE(code.ok()) << code.error().message;
  EXPECT_EQ(code->invocations(), 33u);
}

TEST(SpirvRefuse, TexelPointers) {
  EXPECT_REFUSED("points to no integer texel", {
    a.add(a.globals, Op::OpTypeImage, {20, kFloat, 1, 0, 0, 0, 2, 3});
    a.add(a.globals, Op::OpTypePointer, {21, 0, 20});
    a.add(a.globals, Op::OpVariable, {21, 22, 0});
    a.add(a.globals, Op::OpTypePointer, {23, static_cast<uint32_t>(spv::StorageClass::Image), kFloat});
    a.add(a.body, Op::OpImageTexelPointer, {23, 24, 22, kOne, kOne});
  });
}

// OpConstant has a number where the operations that are allowed have ids.
TEST(SpirvRefuse, SpecializationConstantsOfOtherOperations) {
  for (const uint32_t number : {uint32_t{kOne}, 0xFFFFFFFFu}) {
    EXPECT_REFUSED("OpSpecConstantOp", {
      a.add(a.globals, Op::OpSpecConstantOp, {kUint, 20, static_cast<uint32_t>(Op::OpConstant), number});
    });
  }
}

TEST(SpirvRefuse, OperandsOfAtomics) {
  enum : uint32_t { kInt = 20, kSigned, kReal, kPointer, kVariable };
  const auto added = [](uint32_t value) {
    return outcome_of([&](Assembler& a) {
      a.add(a.globals, Op::OpTypeInt, {kInt, 32, 1});
      a.add(a.globals, Op::OpConstant, {kInt, kSigned, 5});
      a.add(a.globals, Op::OpConstant, {kFloat, kReal, 5});
      a.add(a.globals, Op::OpTypePointer, {kPointer, static_cast<uint32_t>(spv::StorageClass::Workgroup), kUint});
      a.add(a.globals, Op::OpVariable, {kPointer, kVariable, static_cast<uint32_t>(spv::StorageClass::Workgroup)});
      a.add(a.body, Op::OpAtomicIAdd, {kUint, 30, kVariable, kOne, kOne, value});
    });
  };
  EXPECT_EQ(added(kOne), "");
  EXPECT_EQ(added(kSigned), "");
  EXPECT_NE(added(kReal).find("another type"), std::string::npos);
}

TEST(SpirvRefuse, UndefinedPointersThatAreUsed) {
  const auto undefined = [](bool used) {
    return outcome_of([&](Assembler& a) {
      a.add(a.globals, Op::OpTypePointer, {20, static_cast<uint32_t>(spv::StorageClass::Function), kUint});
      a.add(a.body, Op::OpUndef, {20, 21});
      if (used) a.add(a.body, Op::OpLoad, {kUint, 22, 21});
    });
  };
  EXPECT_EQ(undefined(false), "");
  EXPECT_NE(undefined(true), "");
}

TEST(SpirvRefuse, TooMuchSharedMemory) {
  const auto arrays = [](uint32_t length) {
    return outcome_of([&](Assembler& a) {
      a.add(a.globals, Op::OpConstant, {kUint, 20, length});
      a.add(a.globals, Op::OpTypeArray, {21, kFloat, 20});
      a.add(a.globals, Op::OpTypePointer, {23, 4, 21});
      a.add(a.globals, Op::OpVariable, {23, 24, 4});
      a.add(a.globals, Op::OpVariable, {23, 25, 4});
      a.add(a.body, Op::OpCopyMemory, {24, 25});
    });
  };
  EXPECT_EQ(arrays(8192), "");
  EXPECT_NE(arrays(8193).find("larger than maxComputeSharedMemorySize"), std::string::npos);
}

TEST(SpirvRefuse, DeepTypes) {
  Assembler a;
  std::vector<uint32_t> words = a.words();
  for (uint32_t id = 20; id < 220; ++id) a.add(a.globals, Op::OpTypeStruct, {id, id == 20 ? uint32_t{kUint} : id - 1});
  words = a.words();
  words[3] = 300;
  EXPECT_NE(outcome(words).find("nested too deeply"), std::string::npos);
}

TEST(SpirvRefuse, LocationsInCompute) {
  EXPECT_REFUSED("compute shaders have no Locations", {
    a.interface = {25};
    a.add(a.annotations, Op::OpDecorate, {25, static_cast<uint32_t>(spv::Decoration::Location), 0});
    a.add(a.globals, Op::OpTypePointer, {21, static_cast<uint32_t>(spv::StorageClass::Input), kUint});
    a.add(a.globals, Op::OpVariable, {21, 25, static_cast<uint32_t>(spv::StorageClass::Input)});
    a.add(a.body, Op::OpLoad, {kUint, 26, 25});
    a.add(a.body, Op::OpIAdd, {kUint, 27, 26, 26});
  });
}

TEST(SpirvRefuse, DistancesAsInputs) {
  EXPECT_REFUSED("distances that are not supported here", {
    a.interface = {25};
    a.add(a.annotations, Op::OpDecorate,
          {25, static_cast<uint32_t>(spv::Decoration::BuiltIn), static_cast<uint32_t>(spv::BuiltIn::ClipDistance)});
    a.add(a.globals, Op::OpTypeArray, {20, kFloat, kOne});
    a.add(a.globals, Op::OpTypePointer, {21, static_cast<uint32_t>(spv::StorageClass::Input), 20});
    a.add(a.globals, Op::OpVariable, {21, 25, static_cast<uint32_t>(spv::StorageClass::Input)});
    a.add(a.body, Op::OpLoad, {20, 26, 25});
    a.add(a.body, Op::OpCompositeExtract, {kFloat, 27, 26, 0});
    a.add(a.body, Op::OpFAdd, {kFloat, 28, 27, 27});
  });
}

// 2^64 - 2^33 + 1 structures without members: nobody counts them.
TEST(SpirvRefuse, ManyTimesNothing) {
  for (const spv::StorageClass from : {spv::StorageClass::Workgroup, spv::StorageClass::Input}) {
    EXPECT_EQ(outcome_of([&](Assembler& a) {
                a.interface = {25};
                a.add(a.annotations, Op::OpDecorate, {25, static_cast<uint32_t>(spv::Decoration::Location), 0});
                a.add(a.globals, Op::OpConstant, {kUint, 20, 0xFFFFFFFF});
                a.add(a.globals, Op::OpTypeStruct, {21});
                a.add(a.globals, Op::OpTypeArray, {22, 21, 20});
                a.add(a.globals, Op::OpTypeArray, {23, 22, 20});
                a.add(a.globals, Op::OpTypePointer, {24, static_cast<uint32_t>(from), 23});
                a.add(a.globals, Op::OpVariable, {24, 25, static_cast<uint32_t>(from)});
                a.add(a.body, Op::OpLoad, {23, 26, 25});
              }),
              "");
  }
}

// Each function calls the next one twice: 2^19 times the last one, were it inlined.
TEST(SpirvRefuse, ExplosionByInlining) {
  const std::string text = outcome_of([](Assembler& a) {
    for (uint32_t f = 0; f < 20; ++f) {
      const uint32_t id = 20 + 4 * f;
      std::vector<uint32_t>& code = f == 0 ? a.body : a.functions;
      if (f != 0) {
        a.add(code, Op::OpFunction, {kVoid, id - 4, 0, kFunctionType});
        a.add(code, Op::OpLabel, {id - 3});
      }
      if (f != 19) {
        a.add(code, Op::OpFunctionCall, {kVoid, id - 1 - 1, id});
        a.add(code, Op::OpFunctionCall, {kVoid, id - 1, id});
      }
      if (f != 0) {
        a.add(code, Op::OpReturn, {});
        a.add(code, Op::OpFunctionEnd, {});
      }
    }
  });
  EXPECT_NE(text.find("the program is too large"), std::string::npos) << text;
}

}  // namespace
}  // namespace lapilli
