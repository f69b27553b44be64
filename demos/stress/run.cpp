// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "stress/run.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "images/images.hpp"
#include "metrics/metrics.hpp"
#include "stress/random.hpp"

namespace halfshadow::stress {
namespace {
using measure::EngineSession;
using scene::SceneDescription;

struct Picture {
  std::vector<float> visibility;
  std::string fellBack;
};

/// Whether a note of the frame's report says that something else answered than was asked: another technique
/// ("light 0 pcss-mip"), or a coarser way of the same, whose reason begins with a code ("wide-depth-range:
/// …"). What the planner leaves out begins with a code too; it names objects and lights alone.
bool isFallBack(Engine& engine, const SkipRecord& skip) {
  const std::string what = skip.what, why = skip.why;
  for (std::size_t i = 0; i < engine.techniqueCount(); ++i) {
    if (what.starts_with("light ") && what.ends_with(std::string(" ") + engine.technique(i).id)) return true;
  }
  // How many maps a light takes, and of what size, is a choice, except where there were too few texels for as
  // many as were asked.
  if (what.ends_with(" sub-lights")) return why.starts_with("map-too-small:");
  if (what.ends_with(" map_size")) return false;
  const bool planned = std::ranges::count(what, ' ') == 1;
  const std::size_t code = why.find_first_not_of("abcdefghijklmnopqrstuvwxyz-");
  return !planned && code != std::string::npos && code > 0 && why[code] == ':';
}

std::string fallBackOf(Engine& engine, const FrameReport& report) {
  std::string text;
  for (std::size_t i = 0; i < report.skipCount; ++i) {
    const SkipRecord& skip = report.skips[i];
    if (isFallBack(engine, skip))
      text += (text.empty() ? "" : ", ") + std::string(skip.what) + ": " + skip.why;
  }
  return text;
}

/// Not asked for steady or unchanged pictures: their edges are as wide as a texel or a kernel, whatever the
/// light, and jump whole from pixel to pixel.
bool hasFixedEdges(const std::string& technique) {
  constexpr const char* kFixed[] = {"hard", "pcf", "pcf-masked", "vsm", "shadow-volume"};
  return std::ranges::find(kFixed, technique) != std::end(kFixed);
}

class Runner {
 public:
  Runner(EngineSession& session, const std::vector<std::string>& techniques, const Options& options)
      : session_(session), techniques_(techniques), options_(options) {}

  Result<CaseResult> runCase(const Case& asked) {
    CaseResult result{.name = asked.name, .what = asked.what, .rule = asked.rule};
    for (const std::string& technique : techniques_) result.cells.push_back({technique, {}});
    result.cells.push_back({kReferenceColumn, {}});
    const std::vector<Variant> variants = chosenVariants(asked);
    for (const Variant& variant : variants) {
      result.variants.push_back(variant.name);
      if (options_.progress)
        options_.progress(asked.name + " " + variant.name, static_cast<double>(result.variants.size() - 1) /
                                                               static_cast<double>(variants.size()));
      const Status done =
          asked.rule == Rule::steady ? judgeFrames(variant, result) : judgeVariant(asked, variant, result);
      if (!done)
        return Error{done.error().code, asked.name + " " + variant.name + ": " + done.error().message};
    }
    return result;
  }

 private:
  std::vector<Variant> chosenVariants(const Case& asked) const {
    std::vector<Variant> variants = asked.make(options_.seed);
    if (options_.variantsPerCase <= 0 || asked.rule == Rule::base) return variants;
    std::uint64_t mixed = options_.seed;
    for (const char c : asked.name) mixed = 31 * mixed + static_cast<unsigned char>(c);
    Random random(mixed);
    while (variants.size() > static_cast<std::size_t>(options_.variantsPerCase))
      variants.erase(variants.begin() + static_cast<long>(random.below(variants.size())));
    return variants;
  }

  struct BaseResult {
    Errors errors;
    std::vector<float> picture;
  };

  Result<std::vector<float>> traced(const SceneDescription& scene, const scene::AreaLight& light,
                                    const reference::ReceiverImage& receivers, int samples,
                                    std::uint32_t seed) {
    return reference::traceVisibility(scene, light, receivers, {.samples = samples, .seed = seed});
  }

  Result<Yardstick> yardstickOf(const Variant& variant) {
    auto truth = measure::traceTruth(variant.scene, options_.width, options_.height, options_.samples, {});
    if (!truth) return truth.error();
    Yardstick yardstick{.truth = std::move(truth).value()};
    scene::AreaLight center = variant.scene.lights.front();
    center.emission = scene::emissionDirection(center);
    center.halfU = center.halfV = glm::dvec3(0.0);
    auto hard = traced(variant.scene, center, yardstick.truth.receivers, 1, 1);
    if (!hard) return hard.error();
    yardstick.hard = std::move(hard).value();
    yardstick.judged = judgedPixels(yardstick.truth.receivers, variant.scene, variant.judgeBehindLight);
    return yardstick;
  }

  /// Of one image; traceTruth gives that of a difference of two.
  static double noiseOf(const Yardstick& yardstick) { return yardstick.truth.noiseRmse / std::sqrt(2.0); }

  Result<const Yardstick*> baseYardstick(const std::string& base) {
    const auto found = bases_.find(base);
    if (found != bases_.end()) return &found->second;
    auto yardstick = yardstickOf({base, baseScene(base)});
    if (!yardstick) return yardstick.error();
    return &(bases_[base] = std::move(yardstick).value());
  }

  /// What a technique makes of a base scene, rendered once.
  Result<const BaseResult*> baseResult(const std::string& base, const std::string& technique) {
    auto& known = baseResults_[base];
    const auto found = known.find(technique);
    if (found != known.end()) return &found->second;
    auto yardstick = baseYardstick(base);
    if (!yardstick) return yardstick.error();
    BaseResult result;
    if (technique == kReferenceColumn) {
      auto again = traced(baseScene(base), baseScene(base).lights.front(), (*yardstick)->truth.receivers,
                          options_.samples, 2);
      if (!again) return again.error();
      result.picture = std::move(again).value();
    } else {
      auto pictures = render(technique, baseScene(base), {});
      if (!pictures) return pictures.error();
      result.picture = std::move(pictures->front().visibility);
    }
    result.errors = errorsOf(result.picture, **yardstick);
    return &(known[technique] = std::move(result));
  }

  /// One picture a light; the scene's own light when there are none. The engine is new.
  Result<std::vector<Picture>> render(const std::string& technique, const SceneDescription& scene,
                                      const std::vector<scene::AreaLight>& frames) {
    if (Status s = session_.renewEngine(); !s) return s.error();
    if (Status s = session_.set(options_.settings); !s) return s.error();
    if (Status s = session_.choose(technique, {}); !s) return s.error();
    if (Status s = session_.load(scene); !s) return s.error();
    RenderDesc desc{.camera = measure::cameraDesc(*scene.camera)};
    desc.target = {.width = options_.width, .height = options_.height};
    desc.output = measure::visibilityOutputOf(technique);
    std::vector<Picture> pictures;
    for (const scene::AreaLight& light : frames.empty() ? scene.lights : frames) {
      if (!frames.empty()) {
        if (Status s = session_.setLights({light}); !s) return s.error();
      }
      FrameReport report;
      if (Status s = session_.render(desc, report); !s) return s.error();
      Picture picture{.visibility = {}, .fellBack = fallBackOf(session_.engine(), report)};
      auto image = session_.read(options_.width, options_.height);
      if (!image) return image.error();
      picture.visibility = measure::decodeVisibility(*image, desc.output);
      pictures.push_back(std::move(picture));
    }
    return pictures;
  }

  Status judgeVariant(const Case& asked, const Variant& variant, CaseResult& result) {
    const bool shared = sharesTruth(asked.rule);
    Yardstick own;
    const Yardstick* yardstick = &own;
    if (shared) {
      auto base = baseYardstick(variant.base);
      if (!base) return base.error();
      yardstick = *base;
    } else if (asked.rule == Rule::base) {
      auto base = baseYardstick(variant.name);
      if (!base) return base.error();
      yardstick = *base;
    } else {
      auto traced = yardstickOf(variant);
      if (!traced) return traced.error();
      own = std::move(traced).value();
    }
    const bool closed = asked.rule == Rule::dark || asked.rule == Rule::lit;
    std::vector<float> tracedHere;
    if (closed) {
      // The answer replaces the truth; what the ray tracer says becomes its own cell.
      tracedHere = own.truth.visibility;
      std::ranges::fill(own.truth.visibility, asked.rule == Rule::lit ? 1.0f : 0.0f);
      own.hard = own.truth.visibility;
    } else if (shared) {
      const scene::AreaLight& light = variant.scene.lights.front();
      auto receivers = reference::traceReceivers(variant.scene, *variant.scene.camera, light, options_.width,
                                                 options_.height);
      if (!receivers) return receivers.error();
      auto picture = traced(variant.scene, light, *receivers, options_.samples, 2);
      if (!picture) return picture.error();
      tracedHere = std::move(picture).value();
    }
    const Errors hard = errorsOf(yardstick->hard, *yardstick);
    result.noiseRmse = std::max(result.noiseRmse, noiseOf(*yardstick));
    for (Cell& cell : result.cells) {
      VariantResult judgedHere{.variant = variant.name, .hard = hard};
      std::vector<float> picture;
      if (cell.technique == kReferenceColumn) {
        if (tracedHere.empty()) continue;
        picture = tracedHere;
      } else {
        auto rendered = render(cell.technique, variant.scene, {});
        if (!rendered) {
          if (rendered.error().code == ErrorCode::unknownSetting) return rendered.error();
          judgedHere.judgement = {Verdict::refused, rendered.error().message};
          cell.variants.push_back(std::move(judgedHere));
          continue;
        }
        picture = std::move(rendered->front().visibility);
        judgedHere.fellBack = rendered->front().fellBack;
      }
      judgedHere.errors = errorsOf(picture, *yardstick);
      if (closed) {
        judgedHere.judgement =
            asked.rule == Rule::dark ? judgedDark(judgedHere.errors) : judgedLit(judgedHere.errors);
      } else {
        const BaseResult* base = nullptr;
        if (asked.rule != Rule::base) {
          auto found = baseResult(variant.base, cell.technique);
          if (!found) return found.error();
          base = *found;
          judgedHere.base = base->errors;
        }
        judgedHere.judgement = judged(asked.rule, judgedHere.errors, base ? &base->errors : nullptr, hard,
                                      noiseOf(*yardstick), judgedHere.fellBack);
        if (asked.rule == Rule::restated && !hasFixedEdges(cell.technique)) {
          judgedHere.changed = changeBetween(picture, base->picture, *yardstick);
          judgedHere.judgement = alsoUnchanged(std::move(judgedHere.judgement), judgedHere.changed);
        }
      }
      if (Status s = dump(asked, variant, cell.technique, judgedHere, *yardstick, picture); !s) return s;
      cell.variants.push_back(std::move(judgedHere));
    }
    return {};
  }

  Status judgeFrames(const Variant& variant, CaseResult& result) {
    std::vector<Yardstick> yardsticks;
    for (const scene::AreaLight& light : variant.frames) {
      Variant frame = variant;
      frame.scene.lights = {light};
      auto yardstick = yardstickOf(frame);
      if (!yardstick) return yardstick.error();
      yardsticks.push_back(std::move(yardstick).value());
      result.noiseRmse = std::max(result.noiseRmse, noiseOf(yardsticks.back()));
    }
    for (Cell& cell : result.cells) {
      if (cell.technique == kReferenceColumn || hasFixedEdges(cell.technique)) continue;
      VariantResult judgedHere{.variant = variant.name};
      auto rendered = render(cell.technique, variant.scene, variant.frames);
      if (!rendered) {
        judgedHere.judgement = {Verdict::refused, rendered.error().message};
      } else {
        std::vector<std::vector<float>> pictures;
        for (Picture& picture : *rendered) {
          if (judgedHere.fellBack.empty()) judgedHere.fellBack = picture.fellBack;
          pictures.push_back(std::move(picture.visibility));
        }
        judgedHere.jump = jumpBeyondTruth(pictures, yardsticks);
        judgedHere.judgement = judgedSteady(judgedHere.jump);
        judgedHere.errors = errorsOf(pictures.back(), yardsticks.back());
      }
      cell.variants.push_back(std::move(judgedHere));
    }
    return {};
  }

  /// expected | actual | error (red: too bright, blue: too dark; times 4), of cells that are worse or wrong.
  Status dump(const Case& asked, const Variant& variant, const std::string& technique,
              const VariantResult& judgedHere, const Yardstick& yardstick,
              const std::vector<float>& picture) const {
    if (options_.dumpFolder.empty() || judgedHere.judgement.verdict < Verdict::worse) return {};
    const auto columns = static_cast<std::size_t>(options_.width),
               rows = static_cast<std::size_t>(options_.height);
    std::vector<std::uint8_t> pixels(columns * rows * 9);
    const auto byte = [](float value) {
      return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
    };
    for (std::size_t y = 0; y < rows; ++y) {
      std::uint8_t* row = pixels.data() + y * columns * 9;
      for (std::size_t x = 0; x < columns; ++x) {
        const std::size_t i = y * columns + x;
        std::fill_n(row + 3 * x, 3, byte(yardstick.truth.visibility[i]));
        std::fill_n(row + 3 * (columns + x), 3, byte(picture[i]));
        const float error = yardstick.judged[i] ? picture[i] - yardstick.truth.visibility[i] : 0.0f;
        std::uint8_t* difference = row + 3 * (2 * columns + x);
        difference[0] = byte(4.0f * error), difference[2] = byte(-4.0f * error);
        difference[1] = yardstick.judged[i] ? 0 : 40;
      }
    }
    std::string name = asked.name + "-" + variant.name + "-" + technique;
    std::ranges::replace(name, ':', '_');
    return images::writePng(options_.dumpFolder / (name + ".png"), 3 * options_.width, options_.height, 3,
                            pixels);
  }

  EngineSession& session_;
  const std::vector<std::string>& techniques_;
  const Options& options_;
  std::map<std::string, Yardstick> bases_;
  std::map<std::string, std::map<std::string, BaseResult>> baseResults_;
};
}  // namespace

const VariantResult& Cell::gravest() const {
  static const VariantResult kNone;
  if (variants.empty()) return kNone;
  return *std::ranges::max_element(variants, {}, [](const VariantResult& v) { return v.judgement.verdict; });
}

std::size_t Table::count(Verdict verdict) const {
  std::size_t sum = 0;
  for (const CaseResult& c : cases) {
    sum += static_cast<std::size_t>(std::ranges::count_if(c.cells, [&](const Cell& cell) {
      return !cell.variants.empty() && cell.gravest().judgement.verdict == verdict;
    }));
  }
  return sum;
}

std::vector<std::string> shadowTechniques(EngineSession& session) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < session.engine().techniqueCount(); ++i) {
    if (const std::string id = session.engine().technique(i).id; id != "none") ids.push_back(id);
  }
  return ids;
}

Result<Table> run(EngineSession& session, const std::vector<Case>& asked,
                  const std::vector<std::string>& techniques, const Options& options) {
  Table table{.techniques = techniques};
  table.techniques.emplace_back(kReferenceColumn);
  Options of = options;
  double done = 0.0;
  if (options.progress) {
    of.progress = [&](const std::string& stage, double share) {
      options.progress(stage, (done + share) / static_cast<double>(asked.size()));
    };
  }
  Runner runner(session, techniques, of);
  for (const Case& c : asked) {
    auto result = runner.runCase(c);
    if (!result) return result.error();
    table.cases.push_back(std::move(*result));
    ++done;
  }
  return table;
}

}  // namespace halfshadow::stress
