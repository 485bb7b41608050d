"""The report of a study: its outputs, the stores that it refuses, and the page in a real browser."""

import csv
import io
import re
import shutil
import sqlite3
import statistics
import subprocess
from html.parser import HTMLParser
from xml.etree import ElementTree

import study_store
from harness import ProgramTest

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
NASTY = "</script><script>boom()</script> & \"'| `*_\\ ü"


class StoreTest(ProgramTest):
    def store(self, name="study", **options):
        return study_store.Store(self.path(name), **options)

    def rows_of(self, query, *values, name="study"):
        connection = sqlite3.connect(self.path(name) / "study.sqlite")
        self.addCleanup(connection.close)
        return connection.execute(query, values).fetchall()

    def page(self, *arguments, name="page.html"):
        """Writes the page, or skips where the program has no scripts for it."""
        outcome = self.run_program("study", "report", "study", "-o", name, *arguments)
        if outcome.status == 2 and "scripts of the page" in outcome.stderr:
            self.skipTest("the program was built without the page's scripts (scripts/install-dependencies)")
        self.assertEqual(outcome.status, 0, str(outcome))
        return self.path(name).read_text()


class Tables(StoreTest):
    def csv_rows(self, file):
        return list(csv.DictReader(io.StringIO(self.path(file).read_text())))

    def test_means_are_those_of_the_store(self):
        self.store(scenarios=3)
        self.succeed("study", "report", "study", "--csv", "tables")
        rows = self.csv_rows("tables/tables.csv")
        self.assertEqual(len(rows), 2 * 3 * 2 * 2)
        for row in rows:
            found = self.rows_of(
                "SELECT r.preserved_percent, r.speedup, r.lost_mean FROM replays r JOIN scenarios s ON s.id = r.scenario_id "
                "WHERE s.sigma = ? AND r.points = ? AND r.distance = ? AND r.strategy = ? ORDER BY s.scenario",
                float(row["sigma"]), int(row["I"]), float(row["D"]), row["strategy"])
            self.assertEqual(int(row["scenarios"]), 3)
            for k, key in enumerate(("preservation_percent", "speedup", "lost_triangles")):
                values = [line[k] for line in found]
                self.assertAlmostEqual(float(row[key]), statistics.mean(values), places=9)
                self.assertAlmostEqual(float(row[f"{key}_deviation"]), statistics.stdev(values), places=9)

    def test_csv_holds_the_papers_figures(self):
        self.store()
        self.succeed("study", "report", "study", "--csv", "tables")
        row = next(row for row in self.csv_rows("tables/tables.csv")
                   if (row["sigma"], row["I"], row["D"], row["strategy"]) == ("0.25", "200", "1", "chain"))
        paper = study_store.paper_tables()["rae2822", 0.25, 200, 4.0, 1.0]
        self.assertEqual(row["paper_table"], "A15")
        for key in ("generation_triangles", "remodelling_triangles", "preservation_percent", "surplus_percent", "speedup"):
            self.assertEqual(float(row[f"paper_{key}"]), float(paper[key]), key)

    def test_verdict_finds_the_rows_that_are_outside(self):
        self.store(distances=(1,), strategies=("chain",))
        connection = sqlite3.connect(self.path("study") / "study.sqlite")
        connection.execute("UPDATE replays SET generated_triangles_mean = 6000 WHERE points = 200 AND scenario_id = 1")
        connection.execute("UPDATE replays SET generated_triangles_mean = 6000 WHERE points = 200 AND scenario_id = 2")
        connection.execute("UPDATE replays SET preserved_percent = 50 WHERE points = 100")  # not judged: coarse
        connection.commit()
        connection.close()
        figures = self.figures("study", "report", "study", "--csv", "tables", "-o", "report.md")
        self.assertEqual((figures["judged"], figures["inside"]), (2, 1))
        inside = {(row["sigma"], row["I"]): row["inside"] for row in self.csv_rows("tables/verdict.csv")}
        self.assertEqual([inside["0.05", "200"], inside["0.25", "200"], inside["0.05", "100"]], ["0", "1", "0"])
        text = self.path("report.md").read_text()
        self.assertIn("1 of 2 (50 %)", text)
        self.assertIn("| generation count |", text)

    def test_markdown_has_every_row(self):
        self.store(airfoils=("rae2822", "e376"))
        self.succeed("study", "report", "study", "-o", "report.md")
        text = self.path("report.md").read_text()
        self.assertEqual(len(re.findall(r"^### Table A\d+: ", text, re.MULTILINE)), 4)
        self.assertEqual(len(re.findall(r"^\| \d+ \| \d+ \| \d+ \| (chain|renew) \|", text, re.MULTILINE)), 2 * 2 * 3 * 2 * 2)

    def test_verdict_alone(self):
        self.store()
        self.succeed("study", "report", "study", "--verdict", "verdict.md", "-o", "report.md")
        verdict = self.path("verdict.md").read_text()
        self.assertIn("4 of 4 (100 %)", verdict)
        self.assertNotIn("## Tables", verdict)
        self.assertTrue(self.path("report.md").read_text().startswith(verdict))

    def test_store_that_a_study_is_writing(self):
        self.store(missing=1)
        before = self.figures("study", "report", "study", "--verdict", "verdict.md")
        writer = sqlite3.connect(self.path("study") / "study.sqlite")
        self.addCleanup(writer.close)
        writer.execute("PRAGMA journal_mode = WAL")
        writer.execute("DELETE FROM replays WHERE id = 1")
        writer.commit()
        writer.execute("DELETE FROM replays")  # not committed
        self.assertTrue((self.path("study") / "study.sqlite-wal").exists())
        during = self.figures("study", "report", "study", "--verdict", "verdict.md")
        self.assertEqual((before["replays"], during["replays"]), (47, 46))

    def test_real_study(self):
        """The store of a real study, which has the same tables and columns as the generated one."""
        self.succeed("study", "-o", "real", "--pairs", "50/1", "--sigmas", "0.05", "--distances", "1", "--evaluations", 40,
                     "--compare-every", 10, "--threads", 1, "--quiet")
        figures = self.figures("study", "report", "real", "-o", "report.md", "--csv", "tables", "--svg", "figures")
        self.assertTrue(figures["finished"])
        self.assertEqual(figures["rows"], len(self.csv_rows("tables/tables.csv")))
        self.assertIn("figure-5-chain.svg", [path.name for path in self.path("figures").iterdir()])
        self.store("made-up")
        tables = "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name"
        self.assertEqual(self.rows_of(tables, name="made-up"), self.rows_of(tables, name="real"))
        for (table,) in self.rows_of(tables, name="real"):
            columns = f"SELECT name FROM pragma_table_info('{table}') ORDER BY name"
            self.assertEqual(self.rows_of(columns, name="made-up"), self.rows_of(columns, name="real"), table)

    def test_figures_are_well_formed_svg(self):
        self.store()
        self.succeed("study", "report", "study", "--svg", "figures")
        names = sorted(path.name for path in self.path("figures").iterdir())
        for name in ("airfoil-rae2822.svg", "figure-1-removal-regions.svg", "figure-5-chain.svg", "figure-5-fresh.svg",
                     "rae2822-chain-preservation.svg", "rae2822-renew-surplus.svg", "rae2822-lost.svg"):
            self.assertIn(name, names)
        for name in names:
            root = ElementTree.parse(self.path("figures") / name).getroot()
            drawn = [node for node in root.iter() if node.tag.split("}")[1] in ("path", "polyline", "circle")]
            self.assertGreater(len(drawn), 1, name)
        regions = ElementTree.parse(self.path("figures/figure-1-removal-regions.svg")).getroot()
        circles = [node for node in regions.iter() if node.tag.endswith("circle")]
        self.assertGreater(len(circles), 140)  # 150 vertices, of which the trailing edge's stays
        self.assertLessEqual(len(circles), 150)

    def test_the_same_store_gives_the_same_bytes(self):
        self.store()
        for name in ("a", "b"):
            self.succeed("study", "report", "study", "--csv", f"{name}-csv", "--svg", f"{name}-svg", "-o", f"{name}.md")
        files = self.files()
        for name, content in files.items():
            if name.startswith("a-") or name == "a.md":
                self.assertEqual(content, files["b" + name[1:]], name)

    def test_unfinished_study(self):
        self.store(missing=20)
        figures = self.figures("study", "report", "study", "-o", "report.md")
        self.assertFalse(figures["finished"])
        self.assertEqual(figures["replays"], 28)
        text = self.path("report.md").read_text()
        self.assertIn("not finished", text)
        self.assertIn("RAE 2822, σ = 0.25: 20 of 24 replays", text)

    def test_studies_of_other_airfoils_have_no_paper(self):
        self.store(airfoils=("naca:4415",))
        figures = self.figures("study", "report", "study", "-o", "report.md", "--csv", "tables")
        self.assertEqual(figures["judged"], 0)
        self.assertEqual({row["paper_table"] for row in self.csv_rows("tables/tables.csv")}, {""})


class Refusals(StoreTest):
    def refuse(self, *arguments, names):
        return self.refused("study", "report", *arguments, names=names)

    def test_what_is_no_study(self):
        self.refuse("nowhere", "-o", "a.html", names="nowhere")
        self.path("empty").mkdir()
        self.refuse("empty", "-o", "a.html", names="study.sqlite")
        self.path("text").mkdir()
        self.write("text/study.sqlite", "this is no database\n" * 100)
        self.refuse("text", "-o", "a.html", names="study.sqlite")
        self.path("other").mkdir()
        connection = sqlite3.connect(self.path("other/study.sqlite"))
        connection.execute("CREATE TABLE run(key TEXT, value TEXT)")
        connection.close()
        self.refuse("other", "-o", "a.html", names="study.sqlite")

    def test_damaged_store(self):
        self.store()
        content = bytearray((self.path("study/study.sqlite")).read_bytes())
        for at in range(4096, len(content), 4096):
            content[at:at + 200] = b"\xff" * 200
        self.write("study/study.sqlite", bytes(content))
        self.refuse("study", "-o", "a.md", names="study.sqlite")

    def test_cut_store(self):
        self.store()
        content = self.path("study/study.sqlite").read_bytes()
        self.write("study/study.sqlite", content[:len(content) // 2])
        self.refuse("study", "-o", "a.md", names="study.sqlite")

    def test_store_without_a_replay(self):
        self.store(missing=48)
        self.refuse("study", "-o", "a.html", names="no finished replay")

    def test_other_schema(self):
        self.store()
        connection = sqlite3.connect(self.path("study/study.sqlite"))
        connection.execute("UPDATE study SET value = '7' WHERE key = 'schema'")
        connection.commit()
        connection.close()
        self.refuse("study", "-o", "a.html", names="schema '7'")

    def test_outputs(self):
        self.store()
        self.refuse("study", names="no output")
        self.refuse("study", "-o", "a.pdf", names="'.pdf'")
        self.refuse("study", "-o", "missing/a.html", names="missing")
        self.write("file", "")
        self.refuse("study", "--csv", "file", names="file")
        self.refuse("study", "--svg", "missing/figures", names="missing/figures")
        self.refuse("study", "-o", "a.md", "--paper", names="--paper")


class Document(HTMLParser):
    """Counts the elements inside each element of a page and collects the text of its tables."""

    VOID = {"meta", "link", "input", "br", "img", "hr", "base", "source"}

    def __init__(self, text):
        super().__init__()
        self.elements = []  # tag, attributes
        self.stack = []
        self.marks = {}  # of each chart
        self.tables = []  # lists of rows, which are lists of cells
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.elements.append((tag, attributes))
        chart = next((a["data-chart"] for _, a in self.stack if "data-chart" in a), None)
        if "data-chart" in attributes:
            self.marks[attributes["data-chart"]] = 0
        elif chart and tag == "path" and attributes.get("role") == "graphics-symbol":
            self.marks[chart] += 1
        if tag == "table":
            self.tables.append((attributes, []))
        elif tag == "tr" and any(t == "tbody" for t, _ in self.stack):
            self.tables[-1][1].append([])
        elif tag == "td":
            self.tables[-1][1][-1].append("")
        if tag not in self.VOID:
            self.stack.append((tag, attributes))

    def handle_endtag(self, tag):
        while self.stack and self.stack.pop()[0] != tag:
            pass

    def handle_data(self, data):
        if any(tag == "td" for tag, _ in self.stack) and not any(a.get("class") == "difference" for _, a in self.stack):
            self.tables[-1][1][-1][-1] += data


class Page(StoreTest):
    def setUp(self):
        super().setUp()
        if BROWSER is None:
            self.skipTest("needs chromium, which is not installed")

    def open(self, name="page.html"):
        """The page's elements once its scripts have run, and the lines of its console."""
        done = subprocess.run(
            [BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
             f"--user-data-dir={self.path('browser')}", "--virtual-time-budget=120000", "--enable-logging=stderr",
             "--window-size=1280,1000", "--dump-dom", self.path(name).as_uri()],
            capture_output=True, timeout=240, stdin=subprocess.DEVNULL)
        text = done.stdout.decode("utf-8", "replace")
        console = [line for line in done.stderr.decode("utf-8", "replace").splitlines() if "CONSOLE" in line]
        return Document(text), console

    def test_every_table_and_chart_is_there_without_an_error(self):
        self.store(scenarios=2)
        self.page()
        document, console = self.open()
        self.assertEqual(console, [])
        self.assertEqual(dict(document.elements)["html"]["data-charts"], "5 of 5")
        self.assertEqual(len(document.marks), 5)
        for name, marks in document.marks.items():
            self.assertGreater(marks, 5, name)
        tables = [(attributes, rows) for attributes, rows in document.tables if attributes.get("class") == "study"]
        self.assertEqual(len(tables), 2)
        for attributes, rows in tables:
            self.assertEqual(len(rows), 3 * 2)
            self.assertEqual(str(len(rows)), attributes["data-rows"])
            self.assertEqual({len(row) for row in rows}, {3 + 2 + 2 + 5 * 3})
        self.assertEqual(len(next(rows for attributes, rows in document.tables if attributes.get("id") == "verdict-lines")), 2)
        figures = [attributes for tag, attributes in document.elements if tag == "figure"]
        self.assertEqual(len(figures), 4 + 2)  # meshes and outlines

    def test_cells_are_the_means_of_the_store(self):
        self.store(scenarios=2, sigmas=(0.25,), pairs=((200, 4),), distances=(1,))
        self.page()
        document, _ = self.open()
        (row,) = next(rows for attributes, rows in document.tables if attributes.get("class") == "study")
        for k, strategy in enumerate(("chain", "renew")):
            mean = self.rows_of("SELECT avg(preserved_percent) FROM replays WHERE strategy = ?", strategy)[0][0]
            self.assertAlmostEqual(float(row[14 + k]), mean, delta=0.00501)
        paper = study_store.paper_tables()["rae2822", 0.25, 200, 4.0, 1.0]
        self.assertEqual(float(row[13]), float(paper["preservation_percent"]))

    def test_whole_study(self):
        self.store(airfoils=study_store.AIRFOILS, sigmas=(0.01, 0.05, 0.25), pairs=study_store.PAIRS,
                   distances=(0.5, 1, 2, 4), scenarios=1)
        self.page()
        document, console = self.open()
        self.assertEqual(console, [])
        self.assertEqual(dict(document.elements)["html"]["data-charts"], "45 of 45")
        self.assertTrue(all(marks > 10 for marks in document.marks.values()), document.marks)
        tables = [rows for attributes, rows in document.tables if attributes.get("class") == "study"]
        self.assertEqual([len(rows) for rows in tables], [24] * 27)

    def test_names_may_be_anything(self):
        self.store(airfoils=(NASTY,), strategies=("chain",))
        self.page()
        document, console = self.open()
        self.assertEqual(console, [])
        self.assertEqual(dict(document.elements)["html"]["data-charts"], "5 of 5")
        self.assertEqual(sum(tag == "script" for tag, _ in document.elements), 5)
        self.succeed("study", "report", "study", "--svg", "figures", "--csv", "tables", "-o", "report.md")
        rows = list(csv.reader(io.StringIO(self.path("tables/tables.csv").read_text())))
        self.assertEqual({row[0] for row in rows[1:]}, {NASTY})
        for path in self.path("figures").iterdir():
            ElementTree.parse(path)

    def test_nothing_is_fetched(self):
        self.store()
        text = self.page()
        document, console = self.open()
        self.assertEqual(console, [])
        policy = next(attributes["content"] for tag, attributes in document.elements if "http-equiv" in attributes)
        self.assertIn("default-src 'none'", policy)
        for tag, attributes in document.elements:
            self.assertNotIn("src", attributes, tag)
            if tag in ("link", "a") and "href" in attributes:
                self.assertTrue(attributes["href"].startswith("#"), attributes)
        # The content policy reports every request on the console, which the test above relies on.
        self.write("fetching.html", text.replace("<main>", "<main><img src='http://127.0.0.1:9/picture.png'>", 1))
        _, console = self.open("fetching.html")
        self.assertTrue(any("127.0.0.1" in line for line in console), console)
