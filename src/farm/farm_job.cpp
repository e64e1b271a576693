#include "src/farm/farm_job.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/settings/toml_text.h"
#include "src/farm/task_script.h"
#include "src/render/tile.h"

namespace arcus::farm {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int format = 1;

std::string numbered(const FarmJob& job, long long frame) {
  const std::string number = std::to_string(job.frames->first + frame);
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(job.frames->last).size());
  return std::string(digits - number.size(), '0') + number;
}

std::string inside(const FarmJob& job, const std::string& name) { return (fs::path(job.folder) / name).string(); }

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_quoted(word);
  return line;
}

std::string tasks_text(const FarmJob& job) {
  std::string text;
  for (long long task = 0; task < job.task_count(); ++task)
    for (const TaskPart& part : parts_of(job, task)) text += std::to_string(task) + "\t" + command_of(job, part) + "\n";
  return text;
}

std::string record_text(const FarmJob& job) {
  Json record{{"arcus_farm", format}, {"program", job.program}, {"scene", job.scene}, {"picture", job.picture}, {"set", job.overrides}};
  if (job.frames) record["frames"] = {job.frames->first, job.frames->last};
  record["tiles"] = job.tiles;
  record["tiles_per_task"] = job.tiles_per_task;
  record["worker_options"] = job.worker_options;
  record["merge_options"] = job.merge_options;
  return record.dump(1) + "\n";
}

}  // namespace

std::vector<TaskPart> parts_of(const FarmJob& job, long long task) {
  std::vector<TaskPart> parts;
  const long long all = job.tiles * job.frame_count();
  for (long long next = task; next < all; next += job.task_count()) {
    if (parts.empty() || parts.back().frame != next / job.tiles) parts.push_back({next / job.tiles, {}});
    parts.back().tiles.push_back(next % job.tiles);
  }
  return parts;
}

long long task_of(const FarmJob& job, long long frame, long long tile) { return (frame * job.tiles + tile) % job.task_count(); }

std::vector<std::string> overrides_of(const FarmJob& job, long long frame) {
  if (!job.frames) return job.overrides;
  std::vector<std::string> result;
  for (const std::string& one : job.overrides) result.push_back(at_frame(one, *job.frames, job.frames->first + frame));
  return result;
}

std::string folder_of(const FarmJob& job, long long frame) { return job.frames ? inside(job, "frame_" + numbered(job, frame)) : job.folder; }

std::string picture_of(const FarmJob& job, long long frame) {
  return job.frames ? fs::path(job.picture).replace_extension(numbered(job, frame) + ".exr").string() : job.picture;
}

std::string shell_quoted(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=:,@%+-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string command_of(const FarmJob& job, const TaskPart& part) {
  const bool is_all = static_cast<long long>(part.tiles.size()) == job.tiles && job.tiles > 1;
  const std::string tiles = is_all ? "0-" + std::to_string(job.tiles - 1) : render::text_of_tiles(part.tiles);
  std::vector<std::string> words{job.program, "tile", job.scene, "--tiles", tiles + "/" + std::to_string(job.tiles), "--out", folder_of(job, part.frame)};
  for (const std::string& one : overrides_of(job, part.frame)) words.insert(words.end(), {"--set", one});
  words.insert(words.end(), job.worker_options.begin(), job.worker_options.end());
  return joined(words);
}

std::vector<std::string> merge_words_of(const FarmJob& job, long long frame) {
  std::vector<std::string> words{job.program, "merge", folder_of(job, frame), "-o", picture_of(job, frame)};
  words.insert(words.end(), job.merge_options.begin(), job.merge_options.end());
  return words;
}

std::string record_path(const std::string& folder) { return (fs::path(folder) / "farm.json").string(); }

std::optional<FarmJob> read_farm(const std::string& folder) {
  if (!fs::exists(record_path(folder))) return std::nullopt;
  try {
    const Json record = Json::parse(read_text_file(record_path(folder)));
    if (record.at("arcus_farm") != format) throw Error(Fault::mismatch, record_path(folder) + ": of another version of the program");
    FarmJob job;
    job.folder = folder;
    record.at("program").get_to(job.program);
    record.at("scene").get_to(job.scene);
    record.at("picture").get_to(job.picture);
    record.at("set").get_to(job.overrides);
    if (record.contains("frames")) job.frames = FrameRange{record["frames"].at(0), record["frames"].at(1)};
    record.at("tiles").get_to(job.tiles);
    record.at("tiles_per_task").get_to(job.tiles_per_task);
    record.at("worker_options").get_to(job.worker_options);
    record.at("merge_options").get_to(job.merge_options);
    if (job.tiles < 1 || job.tiles_per_task < 1) throw Error(Fault::mismatch, record_path(folder) + ": is damaged. Delete it; tiles that are there are kept");
    return job;
  } catch (const Json::exception&) {
    throw Error(Fault::mismatch, record_path(folder) + ": is damaged. Delete it; tiles that are there are kept");
  }
}

std::string difference(const FarmJob& there, const FarmJob& here) {
  const auto differ = [](const std::string& what, const std::string& a, const std::string& b) { return what + " is " + a + " there and " + b + " here"; };
  const auto frames = [](const FarmJob& job) { return job.frames ? std::to_string(job.frames->first) + ":" + std::to_string(job.frames->last) : std::string("none"); };
  if (there.scene != here.scene) return differ("the scene", "'" + there.scene + "'", "'" + here.scene + "'");
  if (there.overrides != here.overrides) return differ("--set", "'" + joined(there.overrides) + "'", "'" + joined(here.overrides) + "'");
  if (frames(there) != frames(here)) return differ("--frames", frames(there), frames(here));
  if (there.tiles != here.tiles) return differ("--tiles", std::to_string(there.tiles), std::to_string(here.tiles));
  return "";
}

void write_farm(const FarmJob& job, int retries) {
  std::error_code error;
  fs::create_directories(inside(job, "log"), error);
  if (!fs::is_directory(inside(job, "log"))) throw cannot("cannot make the folder " + inside(job, "log"), error.message());
  write_whole_file(inside(job, "tasks.txt"), tasks_text(job));
  write_whole_file(inside(job, "task.sh"), task_script(job.folder, retries));
  std::vector<std::string> merges;
  for (long long frame = 0; frame < job.frame_count(); ++frame) merges.push_back(joined(merge_words_of(job, frame)));
  write_whole_file(inside(job, "merge.sh"), merge_script(merges));
  write_whole_file(record_path(job.folder), record_text(job));  // last: it says that the others are there
}

std::string log_path(const FarmJob& job, long long task) { return inside(job, "log/task_" + std::to_string(task) + ".txt"); }

}  // namespace arcus::farm
