// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/scene_section.hpp"

#include <algorithm>
#include <limits>

#include "report/html.hpp"
#include "report/picture.hpp"
#include "report/scatter_plot.hpp"
#include "report/section.hpp"

namespace halfshadow::report {
namespace {

using measure::TechniqueMeasurement;

std::string settingsText(const TechniqueMeasurement& technique) {
  std::string result;
  for (const measure::Setting& setting : technique.settings) {
    const std::string prefix = technique.id + ".";
    const std::string key = setting.key.starts_with(prefix) ? setting.key.substr(prefix.size()) : setting.key;
    result += (result.empty() ? "" : ", ") + key + " " + setting.value;
  }
  return escaped(result);
}

scenes::ViewCommand viewOf(const SceneReport& scene, const std::string& technique) {
  scenes::ViewCommand view = scene.view;
  view.technique = technique;
  return view;
}

Result<std::string> pictures(const SceneReport& scene) {
  const measure::Truth& truth = scene.truth;
  std::string html = "<div class=\"pair\">\n";
  if (!scene.shaded.pixels.empty()) {
    std::vector<std::uint8_t> opaque = scene.shaded.pixels;
    for (std::size_t i = 3; i < opaque.size(); i += 4) opaque[i] = 255;
    auto uri = pngUri(scene.shaded.width, scene.shaded.height, 4, opaque);
    if (!uri) return uri.error();
    html += "<div>" +
            figureHtml(*uri, scene.shadedWith.empty() ? "Shaded" : "Shaded with " + scene.shadedWith,
                       scene.shaded.width, scene.shaded.height) +
            viewCommandsHtml(viewOf(scene, scene.shadedWith), PictureKind::shaded) + "</div>\n";
  }
  auto reference = visibilityUri(truth.width, truth.height, truth.visibility, truth.receivers.kind);
  if (!reference) return reference.error();
  html +=
      figureHtml(*reference,
                 "Truth: visibility by ray tracing, " + counted(static_cast<std::uint64_t>(truth.samples)) +
                     " light points a pixel, noise RMSE " + fixed(truth.noiseRmse, 4),
                 truth.width, truth.height);
  return html + "</div>\n";
}

Result<std::string> techniqueCard(const SceneReport& scene, const TechniqueMeasurement& technique,
                                  const std::string& label) {
  const measure::Truth& truth = scene.truth;
  std::string html = "<div class=\"card technique\"><h4>" + escaped(label) + "</h4>\n";
  html += "<div class=\"settings\">" + settingsText(technique) + "</div>\n";
  auto visibility = visibilityUri(truth.width, truth.height, technique.visibility, truth.receivers.kind);
  if (!visibility) return visibility.error();
  auto errors =
      errorMapUri(truth.width, truth.height, technique.visibility, truth.visibility, truth.receivers.kind);
  if (!errors) return errors.error();
  html += "<div class=\"two\">" + figureHtml(*visibility, "visibility", truth.width, truth.height) +
          figureHtml(*errors, "error", truth.width, truth.height) + "</div>\n";
  return html + "<div class=\"numbers\">penumbra RMSE <b>" + fixed(technique.error.penumbra.rmse, 4) +
         "</b> · receiver MAE " + fixed(technique.error.receiver.mae, 4) + " · " + timeText(technique.time) +
         " ms</div>" + viewCommandsHtml(viewOf(scene, technique.id), PictureKind::visibility) + "</div>\n";
}

std::string numbersTable(const SceneReport& scene, const std::vector<std::string>& names) {
  double bestRmse = std::numeric_limits<double>::infinity();
  for (const TechniqueMeasurement& t : scene.techniques) {
    if (t.measured()) bestRmse = std::min(bestRmse, t.error.penumbra.rmse);
  }
  std::string html =
      "<div class=\"card scroll\"><table><thead>\n<tr class=\"groups\"><th></th><th colspan=\"3\">penumbra "
      "error</th>"
      "<th colspan=\"2\">receiver error</th><th></th><th colspan=\"2\">time, ms</th><th colspan=\"5\">one "
      "dynamic "
      "frame</th></tr>\n";
  html += tableRow({{"technique"},
                    {"RMSE"},
                    {"p99"},
                    {"max"},
                    {"MAE"},
                    {"bias"},
                    {"taps/px"},
                    {"dynamic"},
                    {"static"},
                    {"passes"},
                    {"FBO switches"},
                    {"loaded"},
                    {"stored"},
                    {"memory"}},
                   "th") +
          "</thead><tbody>\n";
  for (std::size_t i = 0; i < scene.techniques.size(); ++i) {
    const TechniqueMeasurement& t = scene.techniques[i];
    if (!t.measured()) {
      html += "<tr><td>" + escaped(names[i]) + "</td><td class=\"text soft\" colspan=\"13\">" +
              escaped(t.absence()) + "</td></tr>\n";
      continue;
    }
    const auto& penumbra = t.error.penumbra;
    html += tableRow({{escaped(names[i])},
                      {fixed(penumbra.rmse, 4), penumbra.rmse <= bestRmse ? "best" : ""},
                      {fixed(penumbra.p99, 3)},
                      {fixed(penumbra.max, 3)},
                      {fixed(t.error.receiver.mae, 4)},
                      {fixed(t.error.receiver.bias, 4)},
                      {fixed(t.counters.tapsPerPixel, 2)},
                      {timeText(t.time)},
                      {timeText(t.timeStatic)},
                      {counted(t.counters.passes)},
                      {counted(t.counters.framebufferSwitches)},
                      {byteText(t.counters.bytesLoaded)},
                      {byteText(t.counters.bytesStored)},
                      {byteText(t.memoryBytes)}});
  }
  return html +
         "</tbody></table></div>\n<p class=\"soft\">Dynamic: the light moves a little in every frame, so "
         "that nothing "
         "is cached. Static: nothing changes between frames. Bytes are what a tile-based GPU moves to and "
         "from memory. "
         "Bias above 0 is too light.</p>\n";
}

std::string plot(const SceneReport& scene, const std::vector<std::string>& names) {
  std::vector<ScatterPoint> points;
  for (std::size_t i = 0; i < scene.techniques.size(); ++i) {
    const TechniqueMeasurement& t = scene.techniques[i];
    if (t.measured() && t.time.frames > 0)
      points.push_back({names[i], t.time.medianMs, t.error.penumbra.rmse});
  }
  const std::string svg = scatterSvg(points, {"time of a dynamic frame, ms (log)", "penumbra RMSE (log)"});
  if (svg.empty()) return {};
  return "<h3>Run time against error</h3>\n<div class=\"card\">" + svg +
         "</div>\n<p class=\"soft\">Down and left is better. The dashed line joins the techniques that no "
         "other beats "
         "in both.</p>\n";
}

std::string passActions(const measure::PassMeasurement& pass) {
  std::string actions;
  const auto add = [&](bool on, const char* name) {
    if (on) actions += (actions.empty() ? "" : ", ") + std::string(name);
  };
  add(pass.clear, "clear");
  add(pass.load, "load");
  add(pass.store, "store");
  add(pass.discard, "discard");
  return actions;
}

std::string passes(const SceneReport& scene, const std::vector<std::string>& names) {
  std::string html = "<h3>Passes and what was left out</h3>\n<div class=\"card\">\n";
  for (std::size_t i = 0; i < scene.techniques.size(); ++i) {
    const TechniqueMeasurement& t = scene.techniques[i];
    if (!t.measured()) continue;
    html += "<details><summary>" + escaped(names[i]) + " · " + counted(t.passes.size()) +
            (t.passes.size() == 1 ? " pass" : " passes") + ", " + counted(t.counters.draws) + " draws, " +
            counted(t.counters.triangles) + " triangles</summary>\n<div class=\"scroll\"><table><thead>" +
            tableRow({{"pass"},
                      {"target", "text"},
                      {"draws"},
                      {"triangles"},
                      {"actions", "text"},
                      {"loaded"},
                      {"stored"},
                      {"ms"}},
                     "th") +
            "</thead><tbody>\n";
    for (const measure::PassMeasurement& pass : t.passes) {
      html += tableRow({{escaped(pass.name)},
                        {escaped(pass.target), "text"},
                        {counted(pass.draws)},
                        {counted(pass.triangles)},
                        {passActions(pass), "text"},
                        {byteText(pass.bytesLoaded)},
                        {byteText(pass.bytesStored)},
                        {threeDigits(pass.timeMs)}});
    }
    html += "</tbody></table></div>\n";
    if (!t.skipped.empty()) {
      html += "<p>Left out:</p>\n<ul>\n";
      for (const measure::SkipMeasurement& skip : t.skipped) {
        html += "<li>" + escaped(skip.what) + ": " + escaped(skip.why) + "</li>\n";
      }
      html += "</ul>\n";
    }
    html += "</details>\n";
  }
  return html +
         "</div>\n<p class=\"soft\">Pass times are taken one by one, each waited for, so their sum exceeds "
         "the "
         "frame's time.</p>\n";
}

}  // namespace

std::vector<std::string> configurationLabels(const std::vector<TechniqueMeasurement>& techniques) {
  std::vector<std::string> labels;
  for (const TechniqueMeasurement& technique : techniques) {
    std::string label = technique.id;
    for (const measure::Setting& setting : technique.settings) {
      const bool differs =
          std::any_of(techniques.begin(), techniques.end(), [&](const TechniqueMeasurement& other) {
            return other.id == technique.id &&
                   std::any_of(other.settings.begin(), other.settings.end(), [&](const measure::Setting& s) {
                     return s.key == setting.key && s.value != setting.value;
                   });
          });
      if (differs) label += " " + setting.value;
    }
    labels.push_back(label);
  }
  return labels;
}

Result<std::string> sceneSection(const SceneReport& scene, const std::string& anchor) {
  const std::vector<std::string> names = configurationLabels(scene.techniques);
  std::string html = "<section id=\"" + anchor + "\"><h2>" + escaped(scene.title) +
                     "</h2>\n<p class=\"soft\">" + escaped(scene.description) + " " +
                     counted(scene.truth.receiverPixels) + " receiver pixels, " +
                     counted(scene.truth.penumbraPixels) + " of them in penumbra.</p>\n";
  auto top = pictures(scene);
  if (!top) return top.error();
  html +=
      *top + plot(scene, names) + "<h3>Numbers</h3>\n" + numbersTable(scene, names) + "<h3>Pictures</h3>\n";
  html += errorLegend();
  html += "<div class=\"grid\">\n";
  for (std::size_t i = 0; i < scene.techniques.size(); ++i) {
    if (!scene.techniques[i].measured()) continue;
    auto card = techniqueCard(scene, scene.techniques[i], names[i]);
    if (!card) return card.error();
    html += *card;
  }
  return html + "</div>\n" + passes(scene, names) + "</section>\n";
}

}  // namespace halfshadow::report
