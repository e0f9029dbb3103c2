# check_summary.py PROGRAM SCHEMA: what ddem validate writes keeps to the schema, and the schema is not a sieve. Ends with 77 where
# jsonschema is missing.
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError as error:
    print(f"skipped: {error}; Debian has python3-jsonschema")
    sys.exit(77)

program, schema_file = sys.argv[1:]
schema = json.loads(pathlib.Path(schema_file).read_text())
validator_class = jsonschema.validators.validator_for(schema)
validator_class.check_schema(schema)
validator = validator_class(schema)

with tempfile.TemporaryDirectory() as folder:
    campaign = pathlib.Path(folder, "small.toml")
    campaign.write_text(
        '[strip]\nseeds = [1, 2]\nmodels = ["dem"]\nstiffness_ratios = [0.3]\n'
        'discs = 300\nlength = "7.3 mm"\npulse_length = "4 mm"\n'
    )
    case = "static/hexagonal/dem/kt0.30"
    subprocess.run([program, "validate", str(campaign), "-o", folder, "--only", case], check=True, capture_output=True)
    summary = json.loads(pathlib.Path(folder, "summary.json").read_text())
    validator.validate(summary)
    assert [c["id"] for c in summary["cases"]] == [case]

def with_actual(number):
    return [{"metric": "m", "actual": number, "unit": "", "derivation": "", "state": "PASS"}]


faults = {
    "no version": lambda s: s.pop("schema_version"),
    "another version": lambda s: s.update(schema_version=2),
    "no cases": lambda s: s.pop("cases"),
    "a state that is none": lambda s: s["cases"][0].update(state="splendid"),
    "a case without a name": lambda s: s["cases"][0].pop("id"),
    "a number as text": lambda s: s["cases"][0].update(criteria=with_actual("1.0")),
    "a bare null": lambda s: s["cases"][0].update(criteria=with_actual(None)),
}
for name, spoil in faults.items():
    spoilt = copy.deepcopy(summary)
    spoil(spoilt)
    assert not validator.is_valid(spoilt), f"the schema accepts {name}"
print(f"summary.json keeps to its schema, which refuses {len(faults)} faults")
