#pragma once

namespace CLI {
class App;
}

namespace instep {

/// Each function adds one group of commands of `instep` to the app. The callback of the command
/// that the user chose sets `exit_code`: 0 done, 1 it could not be done (one line on stderr said
/// why and what to do). Wrong usage (2) is found by the parser.

/// girth, measure, surface: a cloud in a file, no daemon.
void add_cloud_commands(CLI::App& app, int& exit_code);

/// replay, simulate, record, calibrate: recordings and cameras, no daemon.
void add_recording_commands(CLI::App& app, int& exit_code);

/// scan, cancel, status, watch, list, show, export, delete: talk to the daemon.
void add_station_commands(CLI::App& app, int& exit_code);

/// repeat: results on disk, no daemon.
void add_repeat_command(CLI::App& app, int& exit_code);

/// devices: what is plugged in.
void add_devices_command(CLI::App& app, int& exit_code);

/// doctor: what is wrong with this machine and what to do.
void add_doctor_command(CLI::App& app, int& exit_code);

}  // namespace instep
