"""Makes the store of a study that never ran: the schema of `remodel study`, with figures near the paper's that a seeded
generator makes up. For tests of what reads a store.

    study_store.py DIRECTORY [full]
"""

import csv
import json
import random
import sqlite3
import struct
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
SCHEMA = """
CREATE TABLE study(key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE airfoils(name TEXT PRIMARY KEY, design TEXT NOT NULL);
CREATE TABLE scenarios(id INTEGER PRIMARY KEY, airfoil TEXT NOT NULL, sigma REAL NOT NULL, scenario INTEGER NOT NULL,
   seed INTEGER NOT NULL, evaluations INTEGER, infeasible_samples INTEGER, objective REAL, max_error REAL,
   best TEXT, path BLOB, seconds REAL, UNIQUE(airfoil, sigma, scenario));
CREATE TABLE fresh(scenario_id INTEGER NOT NULL, points INTEGER NOT NULL, gradation REAL NOT NULL, evaluation INTEGER NOT NULL,
   triangles INTEGER NOT NULL, seconds REAL NOT NULL, gradation_bias REAL, gradation_deviation REAL,
   PRIMARY KEY(scenario_id, points, gradation, evaluation)) WITHOUT ROWID;
CREATE TABLE replays(id INTEGER PRIMARY KEY, scenario_id INTEGER NOT NULL, points INTEGER NOT NULL, gradation REAL NOT NULL,
   distance REAL NOT NULL, strategy TEXT NOT NULL, evaluations INTEGER NOT NULL, full_adjustments INTEGER NOT NULL,
   triangles_mean REAL, preserved_percent REAL, lost_mean REAL, generated_triangles_mean REAL, surplus_percent REAL,
   remodel_ms_mean REAL, generate_ms_mean REAL, speedup REAL, min_angle_deg REAL, invalid_meshes INTEGER, recoveries INTEGER,
   refreshes INTEGER, gradation_bias REAL, gradation_deviation REAL, generated_gradation_bias REAL, generated_gradation_deviation REAL,
   seconds REAL, stopped TEXT, detail TEXT, UNIQUE(scenario_id, points, gradation, distance, strategy));
CREATE TABLE blocks(replay_id INTEGER NOT NULL, first INTEGER NOT NULL, last INTEGER NOT NULL, triangles_mean REAL, preserved_percent REAL,
   lost_mean REAL, full_adjustments INTEGER, remodel_ms_mean REAL, surplus_percent REAL, PRIMARY KEY(replay_id, first)) WITHOUT ROWID;
CREATE TABLE comparisons(replay_id INTEGER NOT NULL, evaluation INTEGER NOT NULL, triangles INTEGER NOT NULL, gradation_deviation REAL,
   PRIMARY KEY(replay_id, evaluation)) WITHOUT ROWID;
"""
AIRFOILS = ("goe459", "naca2412", "clarky", "b737c", "rae2822", "naca63206", "e376", "e545", "goe702")
PAIRS = ((50, 1), (100, 2), (200, 4), (300, 6), (400, 8), (700, 14))
REPLAY_COLUMNS = (
    "scenario_id points gradation distance strategy evaluations full_adjustments triangles_mean preserved_percent "
    "lost_mean generated_triangles_mean surplus_percent remodel_ms_mean generate_ms_mean speedup min_angle_deg "
    "invalid_meshes recoveries refreshes gradation_bias gradation_deviation generated_gradation_bias "
    "generated_gradation_deviation seconds stopped"
).split()
# Returns a NACA 4-digit section of the given thickness as CST coefficients.
DESIGN = {"degree": 3, "upper": [0.17, 0.15, 0.15, 0.14], "lower": [-0.17, -0.15, -0.15, -0.14]}


def paper_tables():
    lines = [line for line in (SOURCE / "study" / "data" / "paper_tables.csv").read_text().splitlines() if not line.startswith("#")]
    return {
        (row["airfoil"], float(row["sigma"]), int(row["I"]), float(row["G"]), float(row["D"])): row
        for row in csv.DictReader(lines)
    }


class Store:
    """Writes a complete study, or one without its last `missing` replays."""

    def __init__(self, directory, airfoils=("rae2822",), sigmas=(0.05, 0.25), pairs=PAIRS[:3], distances=(1, 2),
                 scenarios=2, strategies=("chain", "renew"), evaluations=2000, missing=0, seed=1, designs=None):
        self.random = random.Random(seed)
        self.paper = paper_tables()
        self.evaluations = evaluations
        Path(directory).mkdir(parents=True, exist_ok=True)
        self.file = Path(directory) / "study.sqlite"
        self.connection = sqlite3.connect(self.file)
        self.connection.executescript(SCHEMA)
        options = {"airfoils": list(airfoils), "sigmas": list(sigmas),
                   "pairs": [{"points": points, "gradation": gradation} for points, gradation in pairs],
                   "distances": list(distances), "scenarios": scenarios, "evaluations": evaluations,
                   "compare_every": 20, "strategies": list(strategies), "seed": seed}
        machine = {"processor": "made up", "cores": 2, "memory_gb": 8, "system": "none", "compiler": "none"}
        values = {"version": "0.0.0", "options": json.dumps(options), "machine": json.dumps(machine),
                  "created": "2000-01-01T00:00:00Z", "schema": "1"}
        self.connection.executemany("INSERT INTO study VALUES (?,?)", values.items())
        for name in ("naca:0012", *airfoils):
            self.connection.execute("INSERT OR IGNORE INTO airfoils VALUES (?,?)",
                                    (name, json.dumps((designs or {}).get(name, DESIGN))))
        jobs = [(airfoil, sigma, scenario, pair, distance, strategy) for airfoil in airfoils for sigma in sigmas
                for scenario in range(1, scenarios + 1) for pair in pairs for distance in distances for strategy in strategies]
        for job in jobs[:len(jobs) - missing]:
            self.replay(*job)
        self.connection.commit()
        self.connection.close()

    def scenario(self, airfoil, sigma, number):
        found = self.connection.execute("SELECT id FROM scenarios WHERE airfoil = ? AND sigma = ? AND scenario = ?",
                                        (airfoil, sigma, number)).fetchone()
        if found:
            return found[0]
        return self.connection.execute(
            "INSERT INTO scenarios (airfoil, sigma, scenario, seed, evaluations, infeasible_samples, seconds, path) "
            "VALUES (?,?,?,?,?,?,?,?)", (airfoil, sigma, number, number, self.evaluations, 10, 0.5, self.path())).lastrowid

    def path(self, designs=40):
        """Thick and thin sections in turn, so that every design is feasible."""
        values = []
        for _ in range(designs):
            upper = [0.17 + self.random.uniform(-0.02, 0.02) for _ in range(6)]
            lower = [-0.17 + self.random.uniform(-0.02, 0.02) for _ in range(6)]
            values += [0.05, 1e-4, *upper, *lower]
        return b"RMPATH01" + struct.pack(f"<QQ{len(values)}d", 12, designs, *values)

    def near(self, value, relative):
        return value * (1 + self.random.uniform(-relative, relative))

    def replay(self, airfoil, sigma, scenario, pair, distance, strategy):
        points, gradation = pair
        paper = self.paper.get((airfoil, sigma, points, float(gradation), float(distance)))
        fresh = self.near(float(paper["generation_triangles"]) if paper else 23.0 * points, 0.02)
        surplus = float(paper["surplus_percent"]) if paper and strategy == "chain" else 0.0
        surplus += self.random.uniform(-1, 1)
        triangles = fresh * (1 + surplus / 100)
        preserved = (float(paper["preservation_percent"]) if paper else 91.0) + self.random.uniform(-0.8, 0.8)
        remodel = self.near(0.0008 * points, 0.2)
        generate = self.near(0.0004 * points**1.5, 0.1)
        row = dict(
            scenario_id=self.scenario(airfoil, sigma, scenario), points=points, gradation=gradation, distance=distance,
            strategy=strategy, evaluations=self.evaluations, full_adjustments=self.evaluations * 4 // 5,
            triangles_mean=triangles, preserved_percent=preserved, lost_mean=triangles * (1 - preserved / 100),
            generated_triangles_mean=fresh, surplus_percent=surplus, remodel_ms_mean=remodel, generate_ms_mean=generate,
            speedup=generate / remodel, min_angle_deg=30.0 + self.random.random() / 1000, invalid_meshes=0, recoveries=0,
            refreshes=0, gradation_bias=-0.4, gradation_deviation=0.2, generated_gradation_bias=-0.5,
            generated_gradation_deviation=0.13, seconds=1.5, stopped="done")
        marks = ",".join("?" * len(REPLAY_COLUMNS))
        replay = self.connection.execute(f"INSERT INTO replays ({','.join(REPLAY_COLUMNS)}) VALUES ({marks})",
                                         [row[column] for column in REPLAY_COLUMNS]).lastrowid
        self.blocks(replay, triangles, preserved, surplus)

    def blocks(self, replay, triangles, preserved, surplus, count=20):
        size = self.evaluations // count
        for k in range(count):
            early = 1 / (1 + k)
            self.connection.execute(
                "INSERT INTO blocks VALUES (?,?,?,?,?,?,?,?,?)",
                (replay, k * size + 1, (k + 1) * size, triangles * (1 - 0.05 * early), preserved - 5 * early,
                 triangles * (1 - preserved / 100), size, 0.1, None if k % 5 == 4 else surplus * (1 - early)))


if __name__ == "__main__":
    if sys.argv[2:] == ["full"]:
        Store(sys.argv[1], airfoils=AIRFOILS, sigmas=(0.01, 0.05, 0.25), pairs=PAIRS, distances=(0.5, 1, 2, 4), scenarios=3)
    else:
        Store(sys.argv[1])
