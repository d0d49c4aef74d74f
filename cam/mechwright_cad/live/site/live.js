"use strict";
(() => {
{% include "motion.js" %}
{% include "asking.js" %}
{% include "fields.js" %}
{% include "findings.js" %}
{% include "desk.js" %}
})();
