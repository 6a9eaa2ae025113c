#include "interpret/learn/learnt_pack.h"

#include "kernel/base/text/counted.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/printable.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace oriel {

namespace {

/// "0.6 m", as a pack states it.
std::string text_of_value(const RuleBase& rules, const std::string& param, double value) {
  const std::string text = to_string(ParamValue{param, value}, rules);
  return text.substr(text.find('=') + 2);
}

std::string unit_of_param(const RuleBase& rules, const std::string& name) {
  for (const PackParam& param : params_of(rules))
    if (param.name == name) return param.unit;
  return "";
}

std::string interval_text(const ConfidenceInterval& interval) {
  return fmt::format("{:+.4f} .. {:+.4f}", interval.low, interval.high);
}

std::string reason_of(const Learnt& learnt, const LearntParam& param, const RuleBase& rules) {
  return fmt::format(
      "learnt from {}, {} before: {} {:.4f} more with it (95 %: {}), changed this way in {} of {} "
      "folds",
      counted(learnt.samples, "building"), text_of_value(rules, param.value.name, param.before),
      learnt.objective, param.gain, interval_text(param.interval), param.folds, learnt.folds);
}

std::string summary_of(const Learnt& learnt) {
  return fmt::format("{} on held-out folds: {:.4f} before, {:.4f} after", learnt.objective,
                     learnt.held_out_before, learnt.held_out_after);
}

std::string ratio_text(double ratio) {
  return std::isnan(ratio) ? "-" : fmt::format("{:.3f}", ratio);
}

std::string edge_text(const KnifeEdge& edge, const RuleBase& rules) {
  return fmt::format("  {}: at {} the objective is {:+.4f} ({}), {:.1f} % of its range away\n",
                     to_string(ParamValue{edge.param, edge.value}, rules),
                     fmt::format("{:.4f}{}{}", edge.flip, edge.unit.empty() ? "" : " ", edge.unit),
                     edge.change, counted(edge.objects, "object"), 100 * edge.distance_share);
}

std::string classes_text(const Learnt& learnt) {
  std::string text = fmt::format("{:<12} {:>9} {:>9}\n", "class", "F1 before", "F1 after");
  for (const auto& [label, before] : learnt.held_out_classes_before) {
    const auto after = learnt.held_out_classes_after.find(label);
    text += fmt::format(
        "{:<12} {:>9} {:>9}\n", printable(label), ratio_text(before.f1()),
        after == learnt.held_out_classes_after.end() ? "-" : ratio_text(after->second.f1()));
  }
  return text;
}

}  // namespace

std::string learnt_pack(const Learnt& learnt, const RuleBase& rules, const std::string& name,
                        const std::string& extended) {
  std::string text = fmt::format("# Learnt by oriel learn from {}: {}.\n",
                                 counted(learnt.samples, "building"), summary_of(learnt));
  if (learnt.params.empty()) text += fmt::format("# Nothing is changed: {}.\n", learnt.reason);
  text += fmt::format("schema: oriel/1\npack: {{name: {}, version: {}}}\nextends: {}\n", name,
                      rules.version(), extended);
  if (learnt.params.empty()) return text;
  text += "\nparams:\n";
  for (const LearntParam& param : learnt.params)
    text += fmt::format("  {}: {{value: {}, why: \"{}\"}}\n", param.value.name,
                        text_of_value(rules, param.value.name, param.value.value),
                        reason_of(learnt, param, rules));
  return text;
}

std::string to_text(const Learnt& learnt, const RuleBase& rules) {
  std::string text;
  for (const LearntParam& param : learnt.params)
    text += fmt::format("{} -> {}: {} {:+.4f} (95 %: {}), in {} of {} folds\n",
                        to_string(ParamValue{param.value.name, param.before}, rules),
                        text_of_value(rules, param.value.name, param.value.value), learnt.objective,
                        param.gain, interval_text(param.interval), param.folds, learnt.folds);
  if (learnt.params.empty()) text += "the pack stays as it is: " + learnt.reason + "\n";
  text += fmt::format("{} on {}: {:.4f} before, {:.4f} after\n", learnt.objective,
                      counted(learnt.samples, "building"), learnt.before, learnt.after);
  text += summary_of(learnt);
  if (!learnt.params.empty())
    text += fmt::format(", gain {:+.4f} (95 %: {})", learnt.held_out_after - learnt.held_out_before,
                        interval_text(learnt.held_out_gain));
  text += '\n';
  text += classes_text(learnt);
  if (!learnt.knife_edges.empty())
    text += "knife edges: a small change of these moves the objective\n";
  for (const KnifeEdge& edge : learnt.knife_edges) text += edge_text(edge, rules);
  return text;
}

std::string to_json(const Learnt& learnt, const RuleBase& rules) {
  std::string params, edges;
  for (const LearntParam& p : learnt.params)
    params += fmt::format(
        R"({}{{"param":{},"unit":{},"before":{},"value":{},"gain":{},"interval":[{},{}],"folds":{}}})",
        params.empty() ? "" : ",", json_string(p.value.name),
        json_string(unit_of_param(rules, p.value.name)), json_number(p.before),
        json_number(p.value.value), json_number(p.gain), json_number(p.interval.low),
        json_number(p.interval.high), p.folds);
  for (const KnifeEdge& e : learnt.knife_edges)
    edges += fmt::format(
        R"({}{{"param":{},"unit":{},"value":{},"flip":{},"share":{},"change":{},"objects":{}}})",
        edges.empty() ? "" : ",", json_string(e.param), json_string(e.unit), json_number(e.value),
        json_number(e.flip), json_number(e.distance_share), json_number(e.change), e.objects);
  return fmt::format(
      R"({{"objective":{},"buildings":{},"folds":{},"before":{},"after":{},"held_out_before":{},)"
      R"("held_out_after":{},"reason":{},"params":[{}],"knife_edges":[{}]}})",
      json_string(learnt.objective), learnt.samples, learnt.folds, json_number(learnt.before),
      json_number(learnt.after), json_number(learnt.held_out_before),
      json_number(learnt.held_out_after), json_string(learnt.reason), params, edges);
}

}  // namespace oriel
