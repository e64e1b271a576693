#include "src/render/photon_folder.h"

#include <filesystem>
#include <set>
#include <thread>

#include "phase/base/error.h"

namespace arcus::render {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char *ending = ".photons", *range_word = "range", *relaxed_word = "relaxed";

/// Aimed photons in a pass from which on relaxing them takes longer than writing a file.
constexpr std::uint32_t least_shared = 1 << 15;

/// Others of this machine are waited for, who would only become slower if they had to share it with the same work done twice; in all not
/// longer than this, should one of them hang.
constexpr double longest_wait_s = 600, look_again_s = 0.05;

std::string folder_of(const std::string& job_folder) { return (std::filesystem::path(job_folder) / "photons").string(); }

std::string stem_of(const char* word, std::size_t count, std::size_t number) {
  const std::string text = std::to_string(number);
  const std::size_t digits = std::to_string(count - 1).size();
  return std::string(word) + "_" + std::string(digits - text.size(), '0') + text + "_of_" + std::to_string(count);
}

std::string path_in(const std::string& job_folder, const char* word, std::size_t count, std::size_t number) {
  return (std::filesystem::path(folder_of(job_folder)) / (stem_of(word, count, number) + ending)).string();
}

std::set<std::string> names_in(const std::string& folder) {
  std::error_code error;
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) names.insert(entry.path().filename().string());
  return names;
}

/// Whether somebody is writing a file with that stem, or was killed over it on another machine.
bool is_being_made(const std::set<std::string>& names, const std::string& stem) {
  const std::string begin = "." + stem + ".part";
  const auto first = names.lower_bound(begin);
  return first != names.end() && first->starts_with(begin);
}

/// A file with that name must hold what it says, of the job. Throws Fault::mismatch or Fault::incomplete.
void require(const PhotonFacts& facts, const std::string& path, const TileJob& job) {
  if (facts.belongs_to != id_of(job)) {
    const auto there = job_from_json(facts.about);
    const std::string why = there ? difference(*there, job) : "";
    throw Error(Fault::mismatch, path + ": photons of something else: " + (why.empty() ? "the job is another" : why));
  }
  const std::string stem = stem_of(facts.is_relaxed ? relaxed_word : range_word, facts.count, facts.number);
  if (stem + ending != std::filesystem::path(path).filename()) throw Error(Fault::incomplete, path + ": is " + stem + " under another name");
}

}  // namespace

std::string photon_range_path(const std::string& job_folder, std::size_t ranges, std::size_t range) {
  return path_in(job_folder, range_word, ranges, range);
}

std::string relaxed_photons_path(const std::string& job_folder, std::size_t passes, std::size_t pass) {
  return path_in(job_folder, relaxed_word, passes, pass);
}

PhotonSurvey survey_photons(const std::string& job_folder, const TileJob& job, bool is_thorough) {
  PhotonSurvey survey;
  for (const std::string& name : names_in(folder_of(job_folder))) {
    if (name.starts_with(".") || !name.ends_with(ending)) continue;
    const std::string path = (std::filesystem::path(folder_of(job_folder)) / name).string();
    try {
      const PhotonFacts facts = is_thorough ? read_photons(path).facts : read_photon_facts(path);
      require(facts, path, job);
      (facts.is_relaxed ? survey.passes : survey.ranges) = facts.count;
      ++(facts.is_relaxed ? survey.passes_done : survey.ranges_done);
    } catch (const Error& error) {
      if (error.fault() == Fault::mismatch) {
        if (survey.foreign.empty()) survey.foreign_because = error.what();
        survey.foreign.push_back(path);
      } else if (error.fault() != Fault::incomplete) {
        throw;
      }
    }
  }
  return survey;
}

PhotonFolder::PhotonFolder(const std::string& job_folder, const TileJob& job, const PhotonSending& sending, const std::atomic<int>* stop_request,
                           std::function<void(std::string_view)> say)
    : job_folder_(job_folder), job_(job), sending_(sending), stop_request_(stop_request), say_(std::move(say)) {
  const bool shares_relaxed = sending.relaxes() && sending.aimed() >= least_shared;
  const std::size_t ranges = sending.range_count(), passes = shares_relaxed ? static_cast<std::size_t>(sending.settings().passes) : 0;
  ranges_ = {range_word, ranges, std::vector<bool>(ranges)};
  relaxed_ = {relaxed_word, passes, std::vector<bool>(passes)};
  const std::string folder = folder_of(job_folder);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) throw cannot("cannot make the folder " + folder, error.message());
  remove_abandoned_in(folder);
}

std::string PhotonFolder::path_of(const Shelf& shelf, std::size_t number) const { return path_in(job_folder_, shelf.word, shelf.count, number); }

std::vector<PhotonStretch> PhotonFolder::stretches_of(const Shelf& shelf, std::size_t number) const {
  if (&shelf == &ranges_) return sending_.range(number);
  return {{static_cast<std::uint32_t>(number), true, 0, sending_.aimed()}};
}

std::optional<PhotonFolder::Missing> PhotonFolder::missing(Shelf& shelf, double start) const {
  const std::set<std::string> names = names_in(folder_of(job_folder_));
  const auto first = static_cast<std::size_t>(start * static_cast<double>(shelf.count));
  std::optional<Missing> being_made;
  for (std::size_t i = 0; i < shelf.count; ++i) {
    const std::size_t number = (first + i) % shelf.count;
    if (shelf.is_there[number]) continue;
    const std::string stem = stem_of(shelf.word, shelf.count, number);
    if (names.contains(stem + ending)) {
      try {
        require(read_photon_facts(path_of(shelf, number)), path_of(shelf, number), job_);
        shelf.is_there[number] = true;
        continue;
      } catch (const Error& error) {
        if (error.fault() != Fault::incomplete) throw;
      }
    }
    if (!is_being_made(names, stem)) return Missing{number, false};
    if (!being_made) being_made = Missing{number, true};
  }
  return being_made;
}

bool PhotonFolder::wait_for(const Shelf& shelf, const Missing& one) {
  if (!one.is_being_made || waited_s_ >= longest_wait_s || !is_being_written_here(path_of(shelf, one.number))) return false;
  std::this_thread::sleep_for(std::chrono::duration<double>(look_again_s));
  waited_s_ += look_again_s;
  return true;
}

bool PhotonFolder::share(double start) {
  while (!is_stopped()) {
    if (const auto range = missing(ranges_, start)) {
      if (!wait_for(ranges_, *range)) landed(range->number);
    } else if (const auto pass = missing(relaxed_, start)) {
      if (wait_for(relaxed_, *pass)) continue;
      WholeFile file(path_of(relaxed_, pass->number));  // shows others that this pass is being relaxed
      if (read(relaxed_, pass->number)) continue;
      auto photons = caustics_of(pass->number);
      if (photons) relax_here(pass->number, *photons, file);
    } else {
      return true;
    }
  }
  return false;
}

/// Nothing where the file is not there. One that is damaged is deleted.
std::optional<StoredPhotons> PhotonFolder::read(const Shelf& shelf, std::size_t number) const {
  const std::string path = path_of(shelf, number);
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    StoredPhotons stored = read_photons(path);
    require(stored.facts, path, job_);
    if (stored.facts.stretches != stretches_of(shelf, number)) throw Error(Fault::incomplete, path + ": holds other photons than it should");
    return stored;
  } catch (const Error& error) {
    if (error.fault() != Fault::incomplete) throw;
    say_(std::string(error.what()) + "; it is made again");
    std::filesystem::remove(path);
    return std::nullopt;
  }
}

void PhotonFolder::write(Shelf& shelf, std::size_t number, WholeFile& file, StoredPhotons& stored) {
  stored.facts.belongs_to = id_of(job_);
  stored.facts.about = json_of(job_);
  stored.facts.stretches = stretches_of(shelf, number);
  stored.facts.number = number;
  stored.facts.count = shelf.count;
  write_photons(file.temporary_path(), stored);
  file.commit();
  shelf.is_there[number] = true;
}

void PhotonFolder::say_done(const std::string& what, Clock::time_point begin) const {
  char line[100];
  std::snprintf(line, sizeof line, "photons, %s: %.1f s", what.c_str(), std::chrono::duration<double>(Clock::now() - begin).count());
  say_(line);
}

std::optional<std::vector<LandedPhotons>> PhotonFolder::landed(std::size_t range) {
  if (is_stopped()) return std::nullopt;
  if (auto stored = read(ranges_, range)) return std::move(stored->landed);
  return send(range);
}

std::optional<std::vector<LandedPhotons>> PhotonFolder::send(std::size_t range) {
  const auto begin = Clock::now();
  WholeFile file(path_of(ranges_, range));  // shows others that this range is being sent
  auto landed = sending_.send(range, stop_request_);
  if (!landed) return std::nullopt;
  StoredPhotons stored{{}, std::move(*landed)};
  write(ranges_, range, file, stored);
  say_done("range " + std::to_string(range) + " of " + std::to_string(ranges_.count), begin);
  return std::move(stored.landed);
}

std::optional<std::vector<Photon>> PhotonFolder::caustics_of(std::size_t pass) {
  LandedPhotons caustics;
  for (std::size_t range = 0; range < ranges_.count; ++range) {
    const std::vector<PhotonStretch> stretches = sending_.range(range);
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      if (stretches[i].pass != pass || !stretches[i].is_aimed) continue;
      const auto parts = landed(range);
      if (!parts) return std::nullopt;
      caustics.append((*parts)[i]);
    }
  }
  return std::move(caustics.on_surfaces);
}

std::optional<Relaxed> PhotonFolder::relax(std::uint32_t pass, std::vector<Photon>& photons) {
  if (relaxed_.count == 0) return sending_.relax(photons, [this] { return is_stopped(); });
  while (!is_stopped()) {
    if (auto stored = read(relaxed_, pass)) {
      photons = std::move(stored->landed.at(0).on_surfaces);
      return stored->facts.relaxed;
    }
    WholeFile file(path_of(relaxed_, pass));
    std::vector<Photon> moved = photons;
    if (const auto relaxed = relax_here(pass, moved, file)) {
      photons = std::move(moved);
      return relaxed;
    }
  }
  return std::nullopt;
}

/// Nothing, and photons half-way, where it is stopped or another worker was at it too and is ready first.
std::optional<Relaxed> PhotonFolder::relax_here(std::size_t pass, std::vector<Photon>& photons, WholeFile& file) {
  const auto begin = Clock::now();
  const std::string path = path_of(relaxed_, pass);
  const auto relaxed = sending_.relax(photons, [&] { return is_stopped() || std::filesystem::exists(path); });
  if (!relaxed) return std::nullopt;
  StoredPhotons stored{{}, {}};
  stored.facts.is_relaxed = true;
  stored.facts.relaxed = *relaxed;
  stored.landed.push_back({std::move(photons), {}});
  write(relaxed_, pass, file, stored);
  photons = std::move(stored.landed[0].on_surfaces);
  say_done("pass " + std::to_string(pass) + " of " + std::to_string(relaxed_.count) + " relaxed", begin);
  return relaxed;
}

}  // namespace arcus::render
