"""The files around the code name one version and one address, and each other correctly."""

import importlib
import re
import sys
from pathlib import Path

import irbkin
import pytest
import yaml

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[3]
CRATE = tomllib.loads((ROOT / "Cargo.toml").read_text())["package"]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text())
RECIPE = ROOT / "ship" / "conda" / "recipe.yaml"
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
DOCKER = ROOT / "ship" / "docker"


def test_all_versions_are_that_of_the_crate():
    own = {"CITATION.cff": CITATION["version"]}
    for file in [*ROOT.glob("ros/*/package.xml"), *ROOT.glob("ros/*/setup.py"), RECIPE]:
        found = re.search(r'(?:<version>|version[=:] ?")(\d+\.\d+\.\d+)', file.read_text())
        own[str(file.relative_to(ROOT))] = found and found[1]
    assert len(own) >= 6
    assert own == dict.fromkeys(own, CRATE["version"])
    assert irbkin.__version__ == CRATE["version"]
    assert (ROOT / "docs" / "releases" / f"{CRATE['version']}.md").exists()


def test_all_addresses_are_that_of_the_crate():
    address = CRATE["repository"]
    assert CITATION["repository-code"] == address
    assert all(url.startswith(address) for url in PYPROJECT["project"]["urls"].values())
    for file in ["SECURITY.md", "RELEASING.md", "docs/guide/check.md", RECIPE]:
        found = re.findall(r"(?:https://)?github\.com/[\w-]+/irbkin", (ROOT / file).read_text())
        assert found
        assert set(found) <= {address, address.removeprefix("https://")}


def test_the_readme_of_a_release_has_no_relative_link(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "ship")
    absolute = importlib.import_module("readme").absolute
    text = absolute((ROOT / "README.md").read_text(), CRATE["repository"], CRATE["version"])
    links = re.findall(r"\]\(([^)]*)\)", text)
    assert len(links) >= 20
    at_tag = re.compile(rf"{CRATE['repository']}/(?:blob|raw)/v{CRATE['version']}/([^#]*)")
    files = [found[1] for link in links if (found := at_tag.match(link))]
    assert len(files) == len(links)
    assert all((ROOT / file).exists() for file in files)


def test_the_licenses_of_all_crates_are_in_the_wheel():
    files = PYPROJECT["project"]["license-files"]
    assert "THIRDPARTY.txt" in files
    assert all((ROOT / file).exists() for file in files)
    # An Apache license is not repeated in THIRDPARTY.txt.
    assert "LICENSE-APACHE" in files


def test_the_package_says_that_it_is_typed():
    assert (Path(irbkin.__file__).parent / "py.typed").exists()


def test_the_recipe_of_conda_renders_with_the_requirements_of_the_project():
    rattler_build = pytest.importorskip("rattler_build", reason="py-rattler-build is missing")
    variants = rattler_build.VariantConfig(
        {
            "c_compiler": ["gcc"],
            "c_stdlib": ["sysroot"],
            "c_stdlib_version": ["2.17"],
            "rust_compiler": ["rust"],
        }
    )
    recipe = rattler_build.Stage0Recipe.from_file(str(RECIPE))
    (rendered,) = [variant.recipe.to_dict() for variant in recipe.render(variants)]
    assert rendered["package"] == {"name": "irbkin", "version": CRATE["version"]}
    assert rendered["build"]["python"]["version_independent"]
    needed = rendered["requirements"]
    assert [name.rpartition("_")[0] for name in needed["build"][::2]] == ["gcc", "rust"]
    python = PYPROJECT["project"]["requires-python"]
    assert needed["run"] == [
        f"python {python}",
        *(
            re.sub(r"(?=[<>=])", " ", name, count=1)
            for name in PYPROJECT["project"]["dependencies"]
        ),
    ]
    assert f"python-abi3 {python}" in needed["host"]
    (maturin,) = PYPROJECT["build-system"]["requires"]
    assert re.sub(r"(?=[<>=])", " ", maturin, count=1) in needed["host"]
    assert rendered["about"]["license"] == PYPROJECT["project"]["license"] == CRATE["license"]
    assert rendered["about"]["license_file"] == PYPROJECT["project"]["license-files"]


def test_workflows_call_make_targets_that_exist():
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    called = set()
    for workflow in WORKFLOWS:
        for job in yaml.safe_load(workflow.read_text())["jobs"].values():
            commands = "\n".join(step.get("run", "") for step in job["steps"])
            called.update(re.findall(r"make ([a-z-]+)", commands))
            if '"$TARGET"' in commands:
                called.update(row["target"] for row in job["strategy"]["matrix"]["include"])
    assert called >= {"check", "test", "wheel", "deny", "semver", "msrv"}
    assert called <= targets


def test_the_image_of_docker_copies_what_exists():
    sources = re.findall(r"^COPY (\S+)", (DOCKER / "Dockerfile").read_text(), re.MULTILINE)
    kept = (DOCKER / "Dockerfile.dockerignore").read_text().splitlines()
    assert len(sources) == 3
    for source in sources:
        assert f"!{source}" in kept or f"!{source.split('/')[0]}" in kept
        assert source == "dist/*.whl" or (ROOT / source).is_dir()
