{% include "elements.js" %}

{% include "keeping.js" %}

{% include "forms.js" %}

{% include "poses.js" %}

{% include "eye.js" %}

{% include "painter.js" %}

{% include "picking.js" %}

{% include "measuring.js" %}

{% include "tools.js" %}

{% include "space.js" %}

{% include "legend.js" %}
