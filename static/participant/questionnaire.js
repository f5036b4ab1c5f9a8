// The page of a trial of type questionnaire.

import { start } from "./item.js";

start();
