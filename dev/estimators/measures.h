// Monte Carlo measures of the estimators' accuracy, consistency and cost on simulated bearings.
// Each prints a table and compares its results with limits. The same number of runs gives the same
// results.
#pragma once

#include <optional>
#include <string>

#include "dev/estimators/limits.h"

namespace ols::bench {

// Compares the joint least squares of one epoch with the Cramer-Rao bound at the truth, for many
// geometries.
void least_squares_bound(int runs, Limits& limits);

// Compares the filter with the posterior bound, for constant and for slowly changing biases. The
// filter runs with its usual configuration, and with one for biases that may be constant for hours.
void filter_bounds(int runs, Limits& limits);

// Compares the filter with the paper's estimator on a drone that manoeuvres at 200 to 800 m, with
// four stations. Both estimate live: each result uses only the bearings received so far.
void against_paper(int runs, Limits& limits);

// Measures how well crossing targets are kept apart, with misses and false bearings.
void several(int runs, Limits& limits);

// Measures how many targets are found, how often their identities change, and how many ghosts there
// are per hour. Ten targets cross; four fixed stations have detectors, whose tracklets have misses
// and breaks; some tracklets are false.
void traffic(int runs, Limits& limits);

// Measures the time until a target that detectors find is confirmed, and until automatic hand-over
// has led the turning stations to it from an overview station.
void handover(int runs, Limits& limits);

// Compares the filter for recordings and its smoother with least squares at the same instants, on
// recordings of meteors, which move unlike any drone. The meteors last 0.3 to 5 s, fly at 10 to 70
// km/s and are 80 to 200 km away. They are seen by 2 to 6 cameras that state only their noise.
void meteors(int runs, Limits& limits);

// Compares the filter for recordings and its smoother with least squares at the same instants, with
// stations whose only error is noise, and that state no other error. Every allowance that the
// filter makes for other errors then only costs accuracy. A drone manoeuvres for 12 s; 2, 3, 4, 12
// or 100 stations are on a circle with a radius of 250 m, at 15 Hz. Also prints, without a limit,
// the results for a drone that hardly manoeuvres, at 30 Hz.
void noise_only(int runs, Limits& limits);

// Measures which classes the classifier assigns to simulated objects of known class after ten
// seconds, by their size in pixels. The tracks have errors, and other seeds than those from which
// central/classify/class_table.h was made.
void classes(int runs, Limits& limits);
// Writes the true features of simulated tracks, in the format that dev/python/ols_class_table.py
// reads.
void write_class_looks(const std::string& file, int runs);

// Measures the fusion's processor time per bearing and prints one line per site. Some sites have up
// to 1000 stations, with eight stations on each target; others have up to 100 stations, which all
// observe the same targets. only: measures just the site with this number of stations, eight on
// each target.
void cost(Limits& limits, std::optional<int> only = std::nullopt);

}  // namespace ols::bench
