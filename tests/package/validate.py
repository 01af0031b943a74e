#!/usr/bin/python3
"""validate.py SCHEMA FILE...: validates TOML and JSON files against a JSON schema, itself valid; one line for each that is not."""
import json
import pathlib
import sys
import tomllib

import jsonschema

schema = json.loads(pathlib.Path(sys.argv[1]).read_text())
kind = jsonschema.validators.validator_for(schema)
kind.check_schema(schema)
validator = kind(schema)
refused = 0
for path in map(pathlib.Path, sys.argv[2:]):
    load = tomllib.loads if path.suffix == ".toml" else json.loads
    errors = list(validator.iter_errors(load(path.read_text())))
    refused += bool(errors)
    if errors:
        error = jsonschema.exceptions.best_match(errors)
        place = "/".join(map(str, error.absolute_path))
        print(f"{path}: /{place}: {error.message[:300]}")
sys.exit(1 if refused else 0)
