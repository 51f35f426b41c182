#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "daemon/store/storage.h"

namespace instep::test {

/// A disk in memory that forgets what was not flushed when its power is cut: of a folder's changes
/// since its last flush some first ones survive, of a file's unflushed bytes all, none or rubbish.
class SimulatedDisk : public Storage {
 public:
  SimulatedDisk() : root_(std::make_shared<Node>()) { root_->is_folder = true; }

  /// For the bytes of all files together.
  void set_room(std::size_t bytes) { room_ = bytes; }

  void cut_power(std::mt19937_64& random) {
    open_.clear();
    forget(*root_, random);
  }

  Result<File> create_file(const std::filesystem::path& path) override {
    const auto folder = find(path.parent_path());
    if (!folder || folder->names.contains(path.filename())) return failed();
    auto file = std::make_shared<Node>();
    change(*folder)[path.filename()] = file;
    open_.push_back(file);
    return static_cast<File>(open_.size() - 1);
  }
  Result<std::size_t> write(File file, std::string_view bytes) override {
    if (used(*root_) + bytes.size() > room_) return fail(ErrorCode::kNoSpace, "it is full", "");
    open_.at(static_cast<std::size_t>(file))->bytes += bytes;
    return bytes.size();
  }
  Result<void> sync(File file) override {
    auto& node = *open_.at(static_cast<std::size_t>(file));
    node.durable_bytes = node.bytes;
    return {};
  }
  void close(File) override {}

  Result<void> make_folder(const std::filesystem::path& path) override {
    if (const auto there = find(path)) return there->is_folder ? Result<void>() : failed();
    const auto parent = find(path.parent_path());
    if (!parent) return failed();
    auto folder = std::make_shared<Node>();
    folder->is_folder = true;
    change(*parent)[path.filename()] = folder;
    return {};
  }
  Result<void> rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
    const auto parent = find(from.parent_path());
    const auto node = find(from);
    if (!node || from.parent_path() != to.parent_path() || find(to)) return failed();
    auto& names = change(*parent);
    names.erase(from.filename());
    names[to.filename()] = node;
    return {};
  }
  Result<void> remove_file(const std::filesystem::path& path) override { return remove(path); }
  Result<void> remove_folder(const std::filesystem::path& path) override {
    const auto node = find(path);
    if (node && !node->names.empty()) return failed();
    return remove(path);
  }
  Result<void> sync_folder(const std::filesystem::path& path) override {
    const auto folder = find(path);
    if (!folder) return failed();
    folder->history.clear();
    return {};
  }
  Result<void> check_writing(const std::filesystem::path&) override { return {}; }
  Result<bool> take_hold(const std::filesystem::path&) override { return true; }
  void share_hold() override {}
  Result<void> keep_hold(const std::filesystem::path&) override { return {}; }
  Result<std::vector<Entry>> list(const std::filesystem::path& path) override {
    const auto folder = find(path);
    if (!folder || !folder->is_folder) return failed();
    std::vector<Entry> entries;
    for (const auto& [name, node] : folder->names)
      entries.push_back({name, node->is_folder, false});
    return entries;
  }
  Result<std::string> read(const std::filesystem::path& path, std::size_t) override {
    const auto node = find(path);
    if (!node || node->is_folder) return failed();
    return node->bytes;
  }

 private:
  struct Node;
  using Names = std::map<std::string, std::shared_ptr<Node>>;
  struct Node {
    bool is_folder = false;
    Names names;
    std::vector<Names> history;  ///< before each change since the last flush
    std::string bytes;
    std::string durable_bytes;
  };

  static tl::unexpected<Error> failed() { return fail(ErrorCode::kIo, "no such thing", ""); }

  static std::size_t used(const Node& node) {
    std::size_t bytes = node.bytes.size();
    for (const auto& [name, child] : node.names) bytes += used(*child);
    return bytes;
  }

  static Names& change(Node& folder) {
    folder.history.push_back(folder.names);
    return folder.names;
  }

  Result<void> remove(const std::filesystem::path& path) {
    const auto parent = find(path.parent_path());
    if (!parent || !parent->names.contains(path.filename())) return failed();
    change(*parent).erase(path.filename());
    return {};
  }

  std::shared_ptr<Node> find(const std::filesystem::path& path) const {
    auto node = root_;
    for (const auto& part : path) {
      if (part == "/") continue;
      const auto found = node->names.find(part);
      if (found == node->names.end()) return nullptr;
      node = found->second;
    }
    return node;
  }

  static void forget(Node& node, std::mt19937_64& random) {
    if (!node.is_folder) {
      if (node.bytes == node.durable_bytes) return;
      const auto fate = random() % 3;
      if (fate == 0) node.bytes = node.durable_bytes;
      if (fate == 1) node.bytes.resize(random() % (node.bytes.size() + 1), '\0');
      if (fate == 2) node.bytes = std::string(node.bytes.size(), '?');
      node.durable_bytes = node.bytes;
      return;
    }
    const auto kept = random() % (node.history.size() + 1);
    if (kept < node.history.size()) node.names = node.history[kept];
    node.history.clear();
    for (auto& [name, child] : node.names) forget(*child, random);
  }

  std::size_t room_ = std::numeric_limits<std::size_t>::max();
  std::shared_ptr<Node> root_;
  std::vector<std::shared_ptr<Node>> open_;
};

/// Lets the k-th call fail, in one of the ways that storage fails.
class FaultyStorage : public Storage {
 public:
  enum class Fault { kIo, kNoSpace, kShortWrite, kDiesBefore, kDiesAfter };

  FaultyStorage(std::shared_ptr<Storage> behind, Fault fault, std::size_t call)
      : behind_(std::move(behind)), fault_(fault), call_(call) {}

  /// The fault was met.
  bool struck() const { return calls_ >= call_; }

  Result<File> create_file(const std::filesystem::path& path) override {
    return pass<File>([&] { return behind_->create_file(path); });
  }
  Result<std::size_t> write(File file, std::string_view bytes) override {
    if (fault_ == Fault::kShortWrite && calls_ + 1 == call_) bytes = bytes.substr(0, 1);
    return pass<std::size_t>([&] { return behind_->write(file, bytes); });
  }
  Result<void> sync(File file) override {
    return pass<void>([&] { return behind_->sync(file); });
  }
  void close(File file) override { behind_->close(file); }
  Result<void> make_folder(const std::filesystem::path& path) override {
    return pass<void>([&] { return behind_->make_folder(path); });
  }
  Result<void> rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
    return pass<void>([&] { return behind_->rename(from, to); });
  }
  Result<void> remove_file(const std::filesystem::path& path) override {
    return pass<void>([&] { return behind_->remove_file(path); });
  }
  Result<void> remove_folder(const std::filesystem::path& path) override {
    return pass<void>([&] { return behind_->remove_folder(path); });
  }
  Result<void> sync_folder(const std::filesystem::path& path) override {
    return pass<void>([&] { return behind_->sync_folder(path); });
  }
  Result<void> check_writing(const std::filesystem::path& path) override {
    return pass<void>([&] { return behind_->check_writing(path); });
  }
  Result<bool> take_hold(const std::filesystem::path& path) override {
    return pass<bool>([&] { return behind_->take_hold(path); });
  }
  void share_hold() override { behind_->share_hold(); }
  Result<void> keep_hold(const std::filesystem::path& path) override {
    return pass<void>([&] { return behind_->keep_hold(path); });
  }
  Result<std::vector<Entry>> list(const std::filesystem::path& path) override {
    return pass<std::vector<Entry>>([&] { return behind_->list(path); });
  }
  Result<std::string> read(const std::filesystem::path& path, std::size_t most) override {
    return pass<std::string>([&] { return behind_->read(path, most); });
  }

 private:
  template <typename T, typename Call>
  Result<T> pass(Call call) {
    ++calls_;
    const bool dies = fault_ == Fault::kDiesBefore || fault_ == Fault::kDiesAfter;
    const auto error = [&] {
      const auto code = fault_ == Fault::kNoSpace ? ErrorCode::kNoSpace : ErrorCode::kIo;
      return fail(code, "an injected fault", "");
    };
    if (dies && calls_ > call_) return error();
    if (calls_ != call_ || fault_ == Fault::kShortWrite) return call();
    if (fault_ == Fault::kDiesAfter) (void)call();
    return error();
  }

  std::shared_ptr<Storage> behind_;
  Fault fault_;
  std::size_t call_;
  std::size_t calls_ = 0;
};

}  // namespace instep::test
