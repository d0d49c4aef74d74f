"use strict";
(() => {
{% include "motion.js" %}
{% include "asking.js" %}
{% include "fields.js" %}
{% include "findings.js" %}
{% include "handles.js" %}
{% include "desk.js" %}
{% include "wishes.js" %}
{% include "files.js" %}
})();
